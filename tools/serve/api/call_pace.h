// SPDX-License-Identifier: Apache-2.0
// How often clients may call shared functions: the module that serves a call runs above most others of its board, so
// calls in any number would take their time.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::serve {

class CallPace {
 public:
  static constexpr std::size_t kMostInASecond = 10;

  // Returns false if there were as many in the second before `now_ns` (CLOCK_MONOTONIC, never earlier than before);
  // else it counts this one.
  bool begin(std::int64_t now_ns) noexcept {
    constexpr std::int64_t kSecondNs = 1'000'000'000;
    std::int64_t& oldest = begun_ns_.at(next_);
    if (oldest != 0 && now_ns - oldest < kSecondNs) {
      return false;
    }
    oldest = now_ns;
    next_ = (next_ + 1) % kMostInASecond;
    return true;
  }

 private:
  std::array<std::int64_t, kMostInASecond> begun_ns_{};  // ring
  std::size_t next_ = 0;
};

}  // namespace indurop::serve
