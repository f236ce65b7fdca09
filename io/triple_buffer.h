// SPDX-License-Identifier: Apache-2.0
// One writer hands whole values to one reader, and neither ever waits: of three places the writer fills one, the reader
// looks at another, and the third is the newest that is complete. Values in between are lost, which is what is wanted
// of a process image.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace indurop::io {

template <class T>
class TripleBuffer {
 public:
  // Not real-time safe; before anybody reads or writes. All three places become copies of `value`.
  void fill(const T& value) { places_.fill(value); }

  // The writer's: change the place, then publish() it. It holds what was there two or three publications ago.
  [[nodiscard]] T& back() noexcept { return places_[back_]; }
  void publish() noexcept {
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  // The reader's: takes the newest; true if it was not taken before. front() stays as it is until the next update().
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
