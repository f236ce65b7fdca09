// SPDX-License-Identifier: Apache-2.0
// An atomic that lets other fibers run before each access: where processes can meet, in turns that a test chooses.

#pragma once

#include <atomic>

#include "core/rt/fiber.h"

namespace indurop::pools::test {

inline void step() noexcept {
  if (rt::Fiber::current() != nullptr) {
    rt::Fiber::pause();
  }
}

template <class T>
class SteppedAtomic {
 public:
  static constexpr bool is_always_lock_free = std::atomic<T>::is_always_lock_free;
  T load(std::memory_order order = std::memory_order_seq_cst) const noexcept {
    step();
    return value_.load(order);
  }
  void store(T to, std::memory_order order = std::memory_order_seq_cst) noexcept {
    step();
    value_.store(to, order);
  }
  T exchange(T to, std::memory_order order = std::memory_order_seq_cst) noexcept {
    step();
    return value_.exchange(to, order);
  }
  T fetch_add(T more, std::memory_order order = std::memory_order_seq_cst) noexcept {
    step();
    return value_.fetch_add(more, order);
  }
  T fetch_sub(T less, std::memory_order order = std::memory_order_seq_cst) noexcept {
    step();
    return value_.fetch_sub(less, order);
  }
  template <class... Order>
  bool compare_exchange_strong(T& known, T to, Order... order) noexcept {
    step();
    return value_.compare_exchange_strong(known, to, order...);
  }
  template <class... Order>
  bool compare_exchange_weak(T& known, T to, Order... order) noexcept {
    return compare_exchange_strong(known, to, order...);
  }

 private:
  std::atomic<T> value_{};
};

}  // namespace indurop::pools::test

#define INDUROP_POOL_ATOMIC ::indurop::pools::test::SteppedAtomic
