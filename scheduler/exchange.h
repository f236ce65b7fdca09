// SPDX-License-Identifier: Apache-2.0
// Exchanges the code of one module between two of its runs: from one run to the next another version of it is entered,
// with what the previous one kept, and no run is left out. A normal thread prepares and concludes an exchange; the
// thread that runs the module asks it before each run, for as long as the module's gate is Watched.

#pragma once

#include <indurop/module.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scheduler/kernel.h"
#include "scheduler/statistics.h"
#include "scheduler/task.h"

namespace indurop::scheduler {

class Exchange {
 public:
  // What of a version is called.
  struct Code {
    void (*run)() = nullptr;
    Condition condition;
  };
  // Two places of the same kept variable. They do not overlap.
  struct Pair {
    std::byte* old_place = nullptr;
    std::byte* new_place = nullptr;
    std::size_t bytes = 0;
  };
  // A word that is stored when the new version follows.
  struct Word {
    std::atomic<std::uint64_t>* to = nullptr;
    std::uint64_t value = 0;
  };
  // A word that changes whenever something is written that a normal thread has copied.
  struct Version {
    const std::atomic<std::uint64_t>* of = nullptr;
    std::uint64_t copied = 0;  // its value before the copying
  };
  enum class Step : std::uint32_t {
    Waiting,    // the old version runs until the exchange is due
    Done,       // the new version runs, and the old one is ready to
    Settled,    // the new version runs
    GoingBack,  // the old version is to run again, with what the new one keeps now
    Failing,    // the same after a fault, with what the new one kept before the run that failed
    Back,       // the old version runs again
  };
  enum class Reason : std::uint32_t { None, Command, Fault, Overrun, Guard };
  struct Settings {
    Code next;
    std::vector<Pair> pairs;          // copied by the thread that runs the module
    bool offered = false;             // a normal thread copies instead: the exchange waits for offer()
    bool can_return = true;           // `pairs` have all it needs to run the old version again
    std::uint64_t earliest_tick = 0;  // the exchange is not before this tick
    std::vector<Word> words;          // stored in this order, before the first run of the new version
    std::vector<const std::atomic<std::int64_t>*> zeros;  // words that must be 0 for that
    std::vector<Version> versions;                        // of what a normal thread copies, besides what is kept
  };

  explicit Exchange(Settings settings) : settings_(std::move(settings)) {}

  // For one normal thread. Number of the gap between two runs that the module is in; nullopt while it runs.
  [[nodiscard]] std::optional<std::uint64_t> gap() const noexcept;
  // Returns true if no run has begun since: what was read meanwhile is what the module keeps in that gap.
  [[nodiscard]] bool is_still_in(std::uint64_t gap) const noexcept;
  // To be called before the copying in a gap, if nothing is offered: what is written from now on is noticed.
  void note_versions() noexcept;
  // Everything was copied in this gap: the next run is one of the new version, if it is the one that ends the gap and
  // nothing of it was written meanwhile.
  void offer(std::uint64_t gap) noexcept { offered_gap_.store(gap + 1, std::memory_order_release); }
  [[nodiscard]] bool is_offered(std::uint64_t gap) const noexcept;
  // Takes the offer back if something was written that was copied. Returns true if no run takes it any more.
  bool withdraw(std::uint64_t gap) noexcept;

  // Any thread; real-time safe. Lets the old version run again, from the next run on. Returns false if the new version
  // does not run, or the old one cannot continue without a normal thread.
  bool go_back(Reason reason) noexcept { return leave_new(Step::GoingBack, reason); }
  // The same after a fault in its code.
  bool fail() noexcept { return leave_new(Step::Failing, Reason::Fault); }

  // Ends the time in which the old version is ready, if the new one runs. Returns the step after that.
  Step settle() noexcept;

  [[nodiscard]] Step step() const noexcept { return step_.load(std::memory_order_acquire); }
  [[nodiscard]] Reason reason() const noexcept { return reason_.load(std::memory_order_acquire); }
  // Valid when step() has shown Done or Back: first tick of the version that runs now, what the copying took, and from
  // the release to the end of that run (0: it has not ended).
  [[nodiscard]] std::uint64_t first_tick() const noexcept { return first_tick_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t copying_ns() const noexcept { return copying_ns_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t response_ns() const noexcept { return response_ns_.load(std::memory_order_acquire); }

  // For the thread that runs the module: before a run, which may exchange what `task` calls, and after it. Returns true
  // if another version runs from this run on. Real-time safe.
  bool before_run(Task& task, std::uint64_t tick, Kernel& kernel) noexcept;
  void after_run(const RunTimes& times) noexcept;

 private:
  static constexpr std::uint64_t kTaken = UINT64_MAX;  // by a run that begins
  [[nodiscard]] bool is_due(std::uint64_t tick) noexcept;
  [[nodiscard]] bool takes_offer() noexcept;
  [[nodiscard]] bool is_as_copied() const noexcept;
  void copy_back() const noexcept;
  void exchange(Task& task, std::uint64_t tick) noexcept;
  bool leave_new(Step to, Reason reason) noexcept;

  Settings settings_;  // `next` is the code that does not run
  std::atomic<Step> step_{Step::Waiting};
  std::atomic<Reason> reason_{Reason::None};
  std::atomic<std::uint64_t> entries_{0};      // odd while a run is in progress
  std::atomic<std::uint64_t> offered_gap_{0};  // number + 1; 0: none; kTaken
  std::atomic<std::uint64_t> first_tick_{0};
  std::atomic<std::int64_t> copying_ns_{0};
  std::atomic<std::int64_t> response_ns_{0};
};

}  // namespace indurop::scheduler
