// SPDX-License-Identifier: Apache-2.0
// Builds a chunk: its messages, and for each channel an index with the positions of its messages.
//
// Example: `gain`, a double on channel 1, changes at 100 ns and at 200 ns; `tick`, a uint32 on channel 2, at 150 ns. A
// message takes 9 bytes of record head, 22 bytes of fields and its value (CDR: 4 bytes of head, then 8 or 4):
//
//   records()   offset  0   channel 1   100 ns   gain   43 bytes
//               offset 43   channel 2   150 ns   tick   39 bytes
//               offset 82   channel 1   200 ns   gain   43 bytes   125 bytes in all
//   index_of(1)  (100 ns, 0), (200 ns, 82)
//   index_of(2)  (150 ns, 43)
//
// The file gets the records (compressed), then one index record for each channel. The summary at the end of the file
// says where each chunk and its indexes are and which times it covers (100 to 200 ns), so a reader who wants `tick` at
// 150 ns opens this chunk only and goes to byte 43 at once. Offsets count in the records before compression.

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
