// SPDX-License-Identifier: Apache-2.0
// The runs of all tracks of a tape in the order in which they began. In virtual time, many runs have the same time, and
// only their order says which came first. Not real-time safe; one thread at a time.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "store/tape/follower.h"

namespace indurop::recorder {

class RunQueue {
 public:
  // A run that was read from the tape, but is not or only partly written.
  struct Held {
    tape::Run run;
    std::size_t written = 0;  // number of its parts written
  };

  void set_tracks(std::size_t tracks);
  // Begins with the runs that have ended by now, and those that are held.
  void begin(tape::Follower& tape);
  // Returns the track of the next run; nothing: there is none.
  [[nodiscard]] std::optional<std::size_t> next();
  [[nodiscard]] Held& held(std::size_t track) { return *held_[track]; }
  // The run of this track is written: reads its next one.
  void finish(std::size_t track, tape::Follower& tape);
  // The earliest end of the runs that are held.
  [[nodiscard]] std::optional<std::int64_t> earliest_ns() const noexcept;

 private:
  using Next = std::pair<std::uint64_t, std::size_t>;  // when it began, among all runs; its track

  void find_ends(const tape::Follower& tape);
  void read(std::size_t track, tape::Follower& tape);

  std::vector<std::optional<Held>> held_;  // by track
  std::vector<std::uint64_t> ends_;        // of the runs that are read, by track
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next_;
};

}  // namespace indurop::recorder
