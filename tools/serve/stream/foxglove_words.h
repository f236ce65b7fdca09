// SPDX-License-Identifier: Apache-2.0
// The protocol of Foxglove's live connections (https://github.com/foxglove/ws-protocol, version 1): messages of clients
// and messages to them.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "core/schema/schema.h"

namespace indurop::serve {

struct FoxgloveWord {
  std::string op;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscribe;  // id, channel
  std::vector<std::uint32_t> unsubscribe;                          // ids
};

// Parses a client's message. List entries that are not 32-bit numbers are left out. Returns nothing if the text is not
// a JSON object with an `op`.
std::optional<FoxgloveWord> read_foxglove_word(std::string_view text);

namespace foxglove {

std::string server_info(const std::string& version, std::int64_t started_ns);
// One channel of `advertise`: CDR, described by OMG IDL, as in recordings.
base::Json channel(std::uint32_t id, const std::string& topic, const schema::Type& type);
std::string advertise(base::Json channels);
std::string unadvertise(const std::vector<std::uint32_t>& channels);
std::string warning(const std::string& text);
// The binary message with a value; `cdr` is encoded by history/recording/cdr.h.
std::string message(std::uint32_t subscription, std::int64_t wall_ns, std::span<const std::uint8_t> cdr);

}  // namespace foxglove
}  // namespace indurop::serve
