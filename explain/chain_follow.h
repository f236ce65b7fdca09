// SPDX-License-Identifier: Apache-2.0
// How old what a chain of modules handed on really was: values are followed from the run that left them to the run that
// began with them. What cannot be told is counted, not guessed. Pure.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "explain/facts.h"

namespace indurop::explain {

// A run of one of the chain's modules. Times in ns of one clock for all boards.
struct ChainRun {
  std::uint64_t number = 0;  // of the module's runs; one that is missing was not read
  std::int64_t release_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  // The value of the variable before it in the chain when the run began, and of the one behind it when it ended: equal
  // numbers are equal values. 0: not known.
  std::uint64_t seen = 0;
  std::uint64_t left = 0;
};

struct ChainStage {
  std::vector<ChainRun> runs;  // by number
  bool leaves = false;         // what it writes reaches the next stage through the network
};

// From the release of the run that wrote first to the release of one that wrote last. A run that begins late may use
// what was released after itself: that is not old at all.
struct ChainSample {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  [[nodiscard]] std::int64_t age() const noexcept { return to_ns > from_ns ? to_ns - from_ns : 0; }
};

// Together as many as the last stage has runs.
struct ChainAges {
  std::vector<ChainSample> samples;  // of each run for which it is clear
  std::uint64_t foreign = 0;         // a run began with what the stage before it had not left
  std::uint64_t repeated = 0;        // a value came through the network that may be of several runs
  std::uint64_t unread = 0;          // the way back leads to runs that were not read: of before the first, or lost
};

// `stages` are not empty.
ChainAges follow_chain(std::span<const ChainStage> stages);

// How a board kept to its schedule.
struct Keeping {
  std::vector<std::int64_t> longest_ns;  // processor time of one run, by module; without disturbed runs
  std::int64_t late_ns = 0;              // from a release to the begin of the first run of it, at most; likewise
  struct Disturbed {
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
  };
  // A run took longer than its period, or is missing. By begin.
  std::vector<Disturbed> disturbed;
};
Keeping keeping_of(const Facts& facts);

// Whether something of that lies between both ends.
bool was_disturbed(const Keeping& keeping, const ChainSample& sample);

}  // namespace indurop::explain
