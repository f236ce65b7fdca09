// SPDX-License-Identifier: Apache-2.0
#include "recording/chunk_builder.h"

#include <algorithm>
#include <cstddef>

#include "recording/record_bytes.h"

namespace indurop::recording {

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
  append_record(records_, message);
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
