// SPDX-License-Identifier: Apache-2.0
// Measures how long a peer has been silent, in time during which this process was listening: time that this process
// slept, was stopped or was not scheduled on a busy machine does not count, because messages of that time have not been
// read yet.

#pragma once

#include <algorithm>
#include <chrono>

#include "core/rt/clock.h"

namespace indurop::deploy {

class Silence {
 public:
  static constexpr std::chrono::milliseconds kStep{500};  // maximum that is counted between two calls

  Silence() = default;
  explicit Silence(rt::MonoTime begin) noexcept : updated_(begin) {}
  // To be called often. Returns how long the silence has lasted.
  std::chrono::nanoseconds update(rt::MonoTime now) noexcept {
    lasted_ += std::min<std::chrono::nanoseconds>(now - updated_, kStep);
    updated_ = now;
    return lasted_;
  }

 private:
  rt::MonoTime updated_{};
  std::chrono::nanoseconds lasted_{};
};

}  // namespace indurop::deploy
