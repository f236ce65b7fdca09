// SPDX-License-Identifier: Apache-2.0
#include "history/recording/chunk_builder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace indurop::recording {
namespace {

// Same as append_record, in one copy: this runs for each recorded value.
void append_message(Bytes& to, const McapMessage& message) {
  std::array<std::uint8_t, kRecordHead + 22> head{static_cast<std::uint8_t>(Opcode::Message)};
  std::size_t at = 1;
  const auto put = [&](const auto& number) {
    std::memcpy(head.data() + at, &number, sizeof number);
    at += sizeof number;
  };
  put(std::uint64_t{head.size() - kRecordHead + message.data.view.size()});
  put(message.channel);
  put(message.sequence);
  put(message.log_time_ns);
  put(message.publish_time_ns);
  to.insert(to.end(), head.begin(), head.end());
  to.insert(to.end(), message.data.view.begin(), message.data.view.end());
}

}  // namespace

void ChunkBuilder::add(const McapMessage& message) {
  start_ns_ = empty() ? message.log_time_ns : std::min(start_ns_, message.log_time_ns);
  end_ns_ = empty() ? message.log_time_ns : std::max(end_ns_, message.log_time_ns);
  if (message.channel >= indexes_.size()) {
    indexes_.resize(std::size_t{message.channel} + 1);
  }
  McapMessageIndex& index = indexes_[message.channel];
  if (index.entries.empty()) {
    index.channel = message.channel;
    used_.push_back(message.channel);
  }
  index.entries.emplace_back(message.log_time_ns, records_.size());
  append_message(records_, message);
}

void ChunkBuilder::clear() {
  records_.clear();
  for (const std::uint16_t channel : used_) {
    indexes_[channel].entries.clear();
  }
  used_.clear();
  start_ns_ = end_ns_ = 0;
}

}  // namespace indurop::recording
