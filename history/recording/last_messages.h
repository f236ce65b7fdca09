// SPDX-License-Identifier: Apache-2.0
// The last messages before a time: the values that were current then. Chunks are read from that time backwards, and
// only those that, as the index says, have messages of a channel whose last one is not yet found.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "history/recording/mcap_reader.h"

namespace indurop::recording {

// A channel, and which of its messages: see `part_of`.
using MessageKey = std::pair<std::uint16_t, std::uint32_t>;
inline constexpr std::uint32_t kAnyPart = 0xFFFFFFFF;  // all messages of the channel

struct LastMessage {
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  Bytes bytes;
};

// Returns the last message before `before_ns` of each key; there is none of keys without one. `part_of`: the second
// part of a message's key, from its sequence number. Damaged chunks are passed over. The reader's next() is not
// affected. Not real-time safe.
std::map<MessageKey, LastMessage> last_messages(const McapReader& reader, std::uint64_t before_ns,
                                                std::set<MessageKey> wanted,
                                                const std::function<std::uint32_t(std::uint32_t)>& part_of);

}  // namespace indurop::recording
