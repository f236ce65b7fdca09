// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/run_queue.h"

#include <algorithm>

namespace indurop::recorder {

void RunQueue::set_tracks(std::size_t tracks) {
  held_.resize(tracks);
  ends_.resize(tracks);
}

// Finds the ends of all tracks at one moment: a run that ends while they are read must not come before an earlier one
// of a track that was read already. If runs end all the time, there is no such moment.
void RunQueue::find_ends(const tape::Follower& tape) {
  constexpr int kTries = 16;
  bool same = false;
  for (int i = 0; i < kTries && !same; ++i) {
    same = true;
    for (std::size_t track = 0; track < ends_.size(); ++track) {
      const std::uint64_t end = tape.end_of(track);
      same = same && end == ends_[track];
      ends_[track] = end;
    }
  }
}

void RunQueue::read(std::size_t track, tape::Follower& tape) {
  std::optional<Held>& held = held_[track];
  if (!held) {
    held.emplace();
    if (!tape.next(track, held->run, ends_[track])) {
      held.reset();
      return;
    }
  }
  next_.emplace(held->run.tail.order, track);
}

void RunQueue::begin(tape::Follower& tape) {
  next_ = {};
  find_ends(tape);
  for (std::size_t track = 0; track < held_.size(); ++track) {
    read(track, tape);
  }
}

std::optional<std::size_t> RunQueue::next() {
  if (next_.empty()) {
    return std::nullopt;
  }
  const std::size_t track = next_.top().second;
  next_.pop();
  return track;
}

void RunQueue::finish(std::size_t track, tape::Follower& tape) {
  held_[track].reset();
  read(track, tape);
}

std::optional<std::int64_t> RunQueue::earliest_ns() const noexcept {
  std::optional<std::int64_t> first;
  for (const std::optional<Held>& held : held_) {
    if (held) {
      first = std::min(first.value_or(held->run.tail.end_ns), held->run.tail.end_ns);
    }
  }
  return first;
}

}  // namespace indurop::recorder
