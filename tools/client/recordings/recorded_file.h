// SPDX-License-Identifier: Apache-2.0
// Recordings on this host, and the numbers in one over time, for programs that draw them.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace indurop::tools {

struct RecordingFile {
  std::string name;  // "cell~crash.mcap" of a black box, "run.mcap" of a folder of recordings
  std::filesystem::path path;
  std::string node;
  std::string reason;  // why it was recorded; empty: a user requested it
  bool black_box = false;
  std::uint64_t bytes = 0;
  std::int64_t wall_ns = 0;  // time of the last write
};

// Returns the black boxes of all nodes, and the recordings in `folder` (may be empty); the newest first.
std::vector<RecordingFile> list_recordings(const std::filesystem::path& folder);

struct RecordedChannel {
  std::string name;
  std::string unit;
  std::vector<std::string> numbers;  // names of its numbers: "knu::Robot::joints[1].y"
};
struct RecordedContents {
  std::int64_t begin_ns = 0;  // CLOCK_REALTIME
  std::int64_t end_ns = 0;
  bool complete = false;
  std::vector<RecordedChannel> channels;
};
// Errors: not a recording; damaged parts in it are skipped.
Result<RecordedContents, base::Problem> read_contents_of(const std::filesystem::path& path);

struct ValuesRequest {
  std::vector<std::string> names;  // names of numbers
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;  // 0: the end
  std::size_t points = 1000;
};
// The value of each number at `points` times, evenly spaced from begin to end. NaN: not known yet.
struct RecordedValues {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  std::vector<std::vector<double>> lines;
};
// Errors: not a recording; a number that is not in it.
Result<RecordedValues, base::Problem> read_values_of(const std::filesystem::path& path, const ValuesRequest& request);

}  // namespace indurop::tools
