// SPDX-License-Identifier: Apache-2.0
// The lifetime of the variables of a function, a method and of VAR_TEMP: pointers to them are valid until the call
// ends. Calls in which such an address is taken have a number. Real-time safe; for one thread, like a program's scans.

#pragma once

#include <cstdint>

namespace indurop::iec {

class Lifetime {
 public:
  Lifetime() noexcept : outer_(innermost) {
    ++last;
    last += last == 0 ? 1 : 0;
    number_ = last;
    innermost = this;
  }
  Lifetime(const Lifetime&) = delete;
  Lifetime& operator=(const Lifetime&) = delete;
  ~Lifetime() { innermost = outer_; }

  // The number of this call, not 0. Numbers repeat after 4 294 967 295 calls.
  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }
  // Returns whether the call with this number has not ended. Run time is proportional to the number of nested calls
  // that have one.
  [[nodiscard]] static bool lasts(std::uint32_t number) noexcept {
    for (const Lifetime* one = innermost; one != nullptr; one = one->outer_) {
      if (one->number_ == number) {
        return true;
      }
    }
    return false;
  }

  // The number given last; a keyframe keeps it, so that no number of an ended call is given again.
  [[nodiscard]] static constexpr std::uint32_t& last_number() noexcept { return last; }

 private:
  // Each module has its own, which ends when the module is unloaded.
  [[gnu::visibility("hidden")]] inline static const Lifetime* innermost = nullptr;
  [[gnu::visibility("hidden")]] inline static std::uint32_t last = 0;

  const Lifetime* outer_;
  std::uint32_t number_ = 0;
};

}  // namespace indurop::iec
