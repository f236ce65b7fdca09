// SPDX-License-Identifier: Apache-2.0
// Determines the real age of the data that a chain of modules passed on: values are followed from the run that wrote
// them to the run that began with them. What cannot be determined is counted, not guessed. Pure.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "history/explain/facts.h"

namespace indurop::explain {

// A run of one of the chain's modules. Times are in ns of one clock for all boards.
struct ChainRun {
  std::uint64_t number = 0;  // number among the module's runs; a missing one was not read
  std::int64_t release_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  // `seen`: the value of the variable before the module in the chain, at the begin of the run. `left`: that of the
  // variable after it, at the end of the run. Equal numbers are equal values. 0: not known.
  std::uint64_t seen = 0;
  std::uint64_t left = 0;
};

struct ChainStage {
  std::vector<ChainRun> runs;  // by number
  bool leaves = false;         // its output reaches the next stage through the network
};

// The time from the release of the run that wrote first to the release of one that wrote last. A run that begins late
// may use what was released after it: the age is 0 then.
struct ChainSample {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  [[nodiscard]] std::int64_t age() const noexcept { return to_ns > from_ns ? to_ns - from_ns : 0; }
};

// The number of samples and the counts add up to the runs of the last stage.
struct ChainAges {
  std::vector<ChainSample> samples;  // for each run with a definite origin
  std::uint64_t foreign = 0;         // a run began with a value that the stage before had not written
  std::uint64_t repeated = 0;        // a value came through the network that may be from several runs
  std::uint64_t unread = 0;          // traced back to runs that were not read: before the first, or lost
};

// `stages` must not be empty.
ChainAges follow_chain(std::span<const ChainStage> stages);

// The record of a board's adherence to its schedule.
struct Keeping {
  std::vector<std::int64_t> longest_ns;  // maximum processor time of one run, by module; without disturbed runs
  std::int64_t late_ns = 0;  // maximum time from a release to the begin of its first run; without disturbed runs
  struct Disturbed {
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
  };
  // Times in which a run took longer than its period, or is missing. By begin.
  std::vector<Disturbed> disturbed;
};
Keeping keeping_of(const Facts& facts);

// Returns whether a disturbance lies between both ends of the sample.
bool was_disturbed(const Keeping& keeping, const ChainSample& sample);

}  // namespace indurop::explain
