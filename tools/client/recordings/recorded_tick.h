// SPDX-License-Identifier: Apache-2.0
// One tick of a recording: which modules ran in it, with which values, and its neighbours, for programs that step
// through a recording. Reads only the chunks around it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"

namespace indurop::tools {

struct TickRequest {
  std::string board;                  // of a file that joins several recordings; else empty
  std::optional<std::uint64_t> tick;  // else the newest tick at `at_ns`
  std::int64_t at_ns = 0;             // log time
  std::vector<std::string> names;     // names of numbers
};

// A value that was new to a run when it began, or that it wrote.
struct TickValue {
  std::string name;
  bool written = false;
  std::string text;
};
struct TickRun {
  std::string module;
  std::uint64_t number = 0;
  std::int64_t release_ns = 0;  // log times
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  bool faulted = false;
  std::vector<TickValue> values;
};
struct RecordedTick {
  std::uint64_t tick = 0;
  std::optional<std::uint64_t> previous;  // the nearest ticks in which a module ran
  std::optional<std::uint64_t> next;
  std::int64_t begin_ns = 0;    // log time of its first release
  std::int64_t end_ns = 0;      // log time at which its last run ended
  std::vector<TickRun> runs;    // in the order of their ends
  std::vector<double> numbers;  // those of the request, when the last run had ended; NaN: not known
};

// A tick without a run is replaced by the nearest later one that has one, else by the last one. A run that ended more
// than a second after its release is not found. Errors: not a recording of runs, no such board, no run, a number that
// is not in it. Not real-time safe.
Result<RecordedTick, base::Problem> read_tick_of(const std::filesystem::path& path, const TickRequest& request);

// Names of the boards whose recordings were joined in this file; empty: it is of one node, or not readable.
std::vector<std::string> boards_in(const std::filesystem::path& path);

}  // namespace indurop::tools
