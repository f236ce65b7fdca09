// SPDX-License-Identifier: Apache-2.0
// Passes whole values from one writer to one reader without ever waiting: of three places the writer fills one, the
// reader reads another, and the third holds the newest complete value. Older values in between are lost, as intended
// for a process image.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace indurop::io {

template <class T>
class TripleBuffer {
 public:
  // Not real-time safe; call it before any read or write. All three places become copies of `value`.
  void fill(const T& value) { places_.fill(value); }

  // For the writer: change the place, then publish() it. It holds the value of two or three publications ago.
  [[nodiscard]] T& back() noexcept { return places_[back_]; }
  void publish() noexcept {
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  // For the reader: takes the newest value; returns true if it was not taken before. front() does not change until the
  // next update().
  bool update() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) {
      return false;
    }
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  [[nodiscard]] const T& front() const noexcept { return places_[front_]; }

 private:
  static constexpr std::uint8_t kFresh = 4;
  static constexpr std::uint8_t kIndex = 3;

  std::array<T, 3> places_{};
  std::atomic<std::uint8_t> middle_{1};
  std::uint8_t back_ = 0;   // the writer's
  std::uint8_t front_ = 2;  // the reader's
};

}  // namespace indurop::io
