// SPDX-License-Identifier: Apache-2.0
// The difference between two boards' clocks, from the apparent delay of time stamps in each direction: the transport
// delay cancels out and bounds the error. Of several stamps the fastest is the most accurate. Pure; one thread.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::mirror {

class ClockCompare {
 public:
  // Adds a stamp of the other board that has arrived: own clock minus stamp.
  void arrived(std::int64_t delay_ns) noexcept { delays_[count_++ % kWindow] = delay_ns; }
  // Discards all stamps: the other board's clock was set, or the board was restarted.
  void reset() noexcept { count_ = 0; }

  [[nodiscard]] bool has_samples() const noexcept { return count_ > 0; }
  // Returns the fastest of the last stamps, to be reported to the other board.
  [[nodiscard]] std::int64_t least_delay() const noexcept {
    return *std::min_element(delays_.begin(), delays_.begin() + std::min(count_, kWindow));
  }

  struct Offset {
    std::int64_t ns = 0;     // own clock minus the other board's
    std::int64_t bound = 0;  // the true value is within plus or minus this
  };
  // `their_delay`: least_delay() of the other board for our stamps.
  [[nodiscard]] Offset offset(std::int64_t their_delay) const noexcept {
    const std::int64_t mine = least_delay();
    return {(mine - their_delay) / 2, std::max<std::int64_t>(0, (mine + their_delay + 1) / 2)};
  }

 private:
  static constexpr std::size_t kWindow = 16;
  std::array<std::int64_t, kWindow> delays_{};
  std::size_t count_ = 0;
};

}  // namespace indurop::mirror
