// SPDX-License-Identifier: Apache-2.0
// The reading end of one track, which never makes its writer wait: a run that was overwritten meanwhile is counted as
// lost. No content of the memory is trusted before it was checked against its size. Not real-time safe; one thread at a
// time.

#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "store/tape/layout.h"

namespace indurop::tape {

struct Value {
  EntryKind kind{};
  std::uint32_t variable = 0;  // index in the store's directory
  std::span<const std::uint8_t> bytes;
};

// The answer of a call or a channel to a run.
struct Answer {
  std::int64_t code = 0;  // kTooLongToTell: the rest was not recorded
  std::span<const std::uint8_t> bytes;
};

struct Run {
  std::uint32_t module = 0;  // index in the run block, or kOthers
  std::uint32_t flags = 0;
  RunTail tail;
  std::vector<Value> values;         // in the order of the track
  std::vector<std::int64_t> clock;   // results of irp::now_ns()
  std::vector<Answer> answers;       // in the order of its calls
  std::vector<std::uint64_t> words;  // the data that the values point into
};

class TrackReader {
 public:
  // A track in the memory of a tape, and the sizes that it had when it was checked.
  struct Source {
    const TapeTrack* shared = nullptr;
    const std::uint64_t* words = nullptr;
    std::uint64_t size = 0;    // a power of two
    std::uint32_t module = 0;  // index in the run block, or kOthers
  };
  // `from_start`: begins with the oldest run still available; else with the next one. `variables`, of the tape, have to
  // outlive it.
  TrackReader(const Source& source, std::span<const TapeVariable> variables, bool from_start);

  // Reads the next run; `run` is reused. Returns false if there is none yet.
  bool next(Run& run) { return next(run, written()); }
  // The same of the words before `end`, as written() returned it.
  bool next(Run& run, std::uint64_t end);
  [[nodiscard]] std::uint64_t written() const noexcept { return shared_->head.load(std::memory_order_acquire); }
  // There are more variables now; values of those from `shown` on are left out.
  void set_variables(std::span<const TapeVariable> variables, std::size_t shown) noexcept {
    variables_ = variables;
    shown_ = shown;
  }
  [[nodiscard]] std::uint32_t module() const noexcept { return module_; }
  // Runs that were written so far.
  [[nodiscard]] std::uint64_t runs() const noexcept { return shared_->runs.load(std::memory_order_relaxed); }
  // Runs that were overwritten before they were read.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  enum class Reading { Whole, Overtaken, Corrupt };

  void point_to(const std::vector<std::pair<EntryHead, std::size_t>>& found, Run& run) const;
  Reading read_run(std::uint64_t head, Run& run, std::uint64_t& length) const;
  [[nodiscard]] std::uint64_t oldest(std::uint64_t head) const noexcept;
  // Returns false if the words at this place in the track have been overwritten.
  bool copy(std::uint64_t from, std::uint64_t count, std::vector<std::uint64_t>& to) const;

  const TapeTrack* shared_;
  const std::uint64_t* words_;
  std::uint64_t mask_;
  std::uint32_t module_;
  std::span<const TapeVariable> variables_;
  std::size_t shown_;
  std::uint64_t at_ = 0;
  std::uint64_t next_number_ = 0;
  std::uint64_t lost_ = 0;
  bool any_ = false;  // a run was read, so the numbers show what is lost
};

}  // namespace indurop::tape
