// SPDX-License-Identifier: Apache-2.0
// Agrees on the tick of a change between a normal thread and the tick threads of all cores: all of them change before
// the same tick, or none. A proposal counts once it is confirmed; a core that begins its tick before that refuses it.
// One word, so that all see the same. Real-time safe.

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace indurop::scheduler {

class ChangeProposal {
 public:
  // From `tick` on, then in steps of `step` ticks, until `last`.
  struct Time {
    std::uint64_t tick = 0;
    std::uint64_t step = 1;
    std::uint64_t last = 0;
  };

  // Normal thread: proposes the first tick. Then it has to make sure that no core has begun it, and to confirm or to
  // take it back. Returns false if a core has refused.
  void propose(const Time& time) noexcept;
  bool confirm() noexcept;
  void take_back() noexcept { word_.store(0, std::memory_order_seq_cst); }

  // Any thread.
  [[nodiscard]] bool is_there() const noexcept { return word_.load(std::memory_order_seq_cst) != 0; }
  // The tick of the change.
  [[nodiscard]] std::uint64_t tick() const noexcept { return (word_.load(std::memory_order_seq_cst) >> 1) - 1; }

  // Tick thread that begins a tick: returns the tick of a confirmed change that is due; refuses one that is not
  // confirmed.
  std::optional<std::uint64_t> due(std::uint64_t tick) noexcept;
  // The only tick thread: not in this tick, but a step later. After the last one there is no proposal any more.
  void postpone(std::uint64_t tick) noexcept;

 private:
  // A tick + 1 and, in the lowest bit, whether it is confirmed; 0: there is no change.
  static constexpr std::uint64_t proposed(std::uint64_t tick) noexcept { return (tick + 1) << 1; }
  static constexpr std::uint64_t confirmed(std::uint64_t tick) noexcept { return proposed(tick) | 1; }

  Time time_;
  std::atomic<std::uint64_t> word_{0};
};

}  // namespace indurop::scheduler
