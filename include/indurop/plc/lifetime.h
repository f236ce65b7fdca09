// SPDX-License-Identifier: Apache-2.0
// How long the variables of a function, a method and of VAR_TEMP are there: pointers to them are good until the call
// ends. Calls that take such an address have a number. Real-time safe; of one thread, as a program's scans are.

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

  // Of this call, not 0. The numbers begin again after 4 294 967 295 calls.
  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }
  // Whether the call of this number has not ended. Takes as long as there are calls inside each other that have one.
  [[nodiscard]] static bool lasts(std::uint32_t number) noexcept {
    for (const Lifetime* one = innermost; one != nullptr; one = one->outer_) {
      if (one->number_ == number) {
        return true;
      }
    }
    return false;
  }

 private:
  // Each module has its own, and takes them along when it is unloaded.
  [[gnu::visibility("hidden")]] inline static const Lifetime* innermost = nullptr;
  [[gnu::visibility("hidden")]] inline static std::uint32_t last = 0;

  const Lifetime* outer_;
  std::uint32_t number_ = 0;
};

}  // namespace indurop::iec
