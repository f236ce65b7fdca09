// SPDX-License-Identifier: Apache-2.0
// Builds a chunk: its messages, and the positions of the messages of each channel.

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "history/recording/records.h"

namespace indurop::recording {

class ChunkBuilder {
 public:
  void add(const McapMessage& message);
  // Discards all messages; the memory is reused.
  void clear();

  [[nodiscard]] bool empty() const noexcept { return records_.empty(); }
  [[nodiscard]] View records() const noexcept { return records_; }
  // The first and the last log time.
  [[nodiscard]] std::uint64_t start_ns() const noexcept { return start_ns_; }
  [[nodiscard]] std::uint64_t end_ns() const noexcept { return end_ns_; }
  // The channels with messages in this chunk, each with log times and offsets in records().
  [[nodiscard]] const std::vector<std::uint16_t>& channels() const noexcept { return used_; }
  [[nodiscard]] const McapMessageIndex& index_of(std::uint16_t channel) const { return indexes_[channel]; }

 private:
  Bytes records_;
  std::uint64_t start_ns_ = 0;
  std::uint64_t end_ns_ = 0;
  std::vector<McapMessageIndex> indexes_;  // by channel
  std::vector<std::uint16_t> used_;
};

}  // namespace indurop::recording
