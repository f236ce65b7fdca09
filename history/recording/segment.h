// SPDX-License-Identifier: Apache-2.0
// A part of a recording that is read as a whole: a chunk, or consecutive messages outside of chunks.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/compression.h"
#include "history/recording/input_file.h"
#include "history/recording/records.h"

namespace indurop::recording {

struct Segment {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  bool is_chunk = false;
  std::uint64_t start_ns = 0;  // of the log times
  std::uint64_t end_ns = 0;
  std::vector<std::uint16_t> channels = {};  // those with messages in it; empty: not known
};

struct LoadedSegment {
  // The position of a message's content among the records.
  struct Entry {
    std::uint64_t log_time_ns = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
  };
  Block records;
  std::vector<Entry> messages;  // in the order of their log times, those of the same time in the order of the file
  std::vector<McapSchema> schemas;
  std::vector<McapChannel> channels;

  [[nodiscard]] McapMessage message(const Entry& entry) const;
};

// Errors, each with its position: cannot be read, wrong CRC, not compressed as announced, invalid records.
Result<LoadedSegment, base::Problem> load(const InputFile& file, const Segment& segment);

}  // namespace indurop::recording
