// SPDX-License-Identifier: Apache-2.0
#include "scheduler/exchange.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace indurop::scheduler {

std::optional<std::uint64_t> Exchange::gap() const noexcept {
  const std::uint64_t entries = entries_.load(std::memory_order_acquire);
  return entries % 2 == 0 ? std::optional(entries) : std::nullopt;
}

bool Exchange::is_still_in(std::uint64_t gap) const noexcept {
  std::atomic_thread_fence(std::memory_order_acquire);  // after all that was read
  return entries_.load(std::memory_order_relaxed) == gap;
}

void Exchange::note_versions() noexcept {
  for (Version& version : settings_.versions) {
    version.copied = version.of->load(std::memory_order_acquire);
  }
}

bool Exchange::is_as_copied() const noexcept {
  return std::all_of(settings_.versions.begin(), settings_.versions.end(), [](const Version& version) {
    return version.of->load(std::memory_order_acquire) == version.copied;
  });
}

bool Exchange::is_offered(std::uint64_t gap) const noexcept {
  const std::uint64_t offered = offered_gap_.load(std::memory_order_acquire);
  return offered == gap + 1 || offered == kTaken;
}

bool Exchange::withdraw(std::uint64_t gap) noexcept {
  std::uint64_t offered = gap + 1;
  return !is_as_copied() && offered_gap_.compare_exchange_strong(offered, 0, std::memory_order_acq_rel);
}

// What was copied while a run began is part of another gap, whatever order it is seen in. While the offer is taken, the
// normal thread changes nothing.
bool Exchange::takes_offer() noexcept {
  std::uint64_t offered = entries_.load(std::memory_order_relaxed) + 1;
  if (!offered_gap_.compare_exchange_strong(offered, kTaken, std::memory_order_acq_rel)) {
    return false;
  }
  if (!is_as_copied()) {
    offered_gap_.store(0, std::memory_order_release);
    return false;
  }
  return true;
}

bool Exchange::is_due(std::uint64_t tick) noexcept {
  return tick >= settings_.earliest_tick &&
         std::all_of(settings_.zeros.begin(), settings_.zeros.end(),
                     [](const auto* word) { return word->load(std::memory_order_acquire) == 0; }) &&
         (!settings_.offered || takes_offer());
}

bool Exchange::leave_new(Step to, Reason reason) noexcept {
  Step step = settings_.can_return ? step_.load(std::memory_order_acquire) : Step::Waiting;
  while (step == Step::Done || (step == Step::GoingBack && to == Step::Failing)) {
    if (step_.compare_exchange_weak(step, to, std::memory_order_acq_rel)) {
      Reason none = Reason::None;
      reason_.compare_exchange_strong(none, reason, std::memory_order_acq_rel);
      return true;
    }
  }
  return false;
}

Exchange::Step Exchange::settle() noexcept {
  Step done = Step::Done;
  return step_.compare_exchange_strong(done, Step::Settled, std::memory_order_acq_rel) ? Step::Settled : done;
}

void Exchange::copy_back() const noexcept {
  for (const Pair& pair : settings_.pairs) {
    std::memcpy(pair.old_place, pair.new_place, pair.bytes);
  }
}

void Exchange::exchange(Task& task, std::uint64_t tick) noexcept {
  std::swap(task.run, settings_.next.run);
  std::swap(task.condition, settings_.next.condition);
  first_tick_.store(tick, std::memory_order_relaxed);
  response_ns_.store(0, std::memory_order_relaxed);
}

bool Exchange::before_run(Task& task, std::uint64_t tick, Kernel& kernel) noexcept {
  const Step step = step_.load(std::memory_order_acquire);
  const bool goes_back = step == Step::GoingBack || step == Step::Failing;
  const bool exchanged = goes_back || (step == Step::Waiting && is_due(tick));
  if (step == Step::Waiting && exchanged) {
    const rt::MonoTime begin = kernel.now();
    for (const Pair& pair : settings_.pairs) {
      std::memcpy(pair.new_place, pair.old_place, pair.bytes);
    }
    exchange(task, tick);
    for (const Word& word : settings_.words) {
      word.to->store(word.value, std::memory_order_release);
    }
    copying_ns_.store((kernel.now() - begin).count(), std::memory_order_relaxed);
    step_.store(Step::Done, std::memory_order_release);
  } else if (step == Step::Done && settings_.can_return) {
    copy_back();  // before each run, so that after a fault the old version goes on from here
  } else if (goes_back) {
    if (step == Step::GoingBack) {
      copy_back();
    }
    exchange(task, tick);
    step_.store(Step::Back, std::memory_order_release);
  }
  // Still odd after a run that a fault ended.
  entries_.store((entries_.load(std::memory_order_relaxed) + 1) | 1U, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);  // before anything that the run writes
  return exchanged;
}

void Exchange::after_run(const RunTimes& times) noexcept {
  if (response_ns_.load(std::memory_order_relaxed) == 0) {
    response_ns_.store(times.end_ns - times.release_ns, std::memory_order_release);
  }
  entries_.store(entries_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

}  // namespace indurop::scheduler
