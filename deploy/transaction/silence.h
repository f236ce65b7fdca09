// SPDX-License-Identifier: Apache-2.0
// How long nothing was heard of somebody, by the time in which this process listened: what it slept itself, stopped or
// on a machine that is too busy, does not count, because words that came meanwhile have not been read yet.

#pragma once

#include <algorithm>
#include <chrono>

#include "rt/clock.h"

namespace indurop::deploy {

class Silence {
 public:
  static constexpr std::chrono::milliseconds kStep{500};  // at most, of the time between two looks

  Silence() = default;
  explicit Silence(rt::MonoTime begin) noexcept : looked_(begin) {}
  // Call often. Returns how long it has lasted.
  std::chrono::nanoseconds look(rt::MonoTime now) noexcept {
    lasted_ += std::min<std::chrono::nanoseconds>(now - looked_, kStep);
    looked_ = now;
    return lasted_;
  }

 private:
  rt::MonoTime looked_{};
  std::chrono::nanoseconds lasted_{};
};

}  // namespace indurop::deploy
