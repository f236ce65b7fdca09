// SPDX-License-Identifier: Apache-2.0
#include "control/io/cia402_probe.h"

#include "control/io/encoder_mark.h"

namespace indurop::io {
namespace {

constexpr unsigned kSwitchedOn = 1U << 0U;
constexpr unsigned kEveryTime = 1U << 1U;
constexpr unsigned kMark = 1U << 2U;
constexpr unsigned kRise = 1U << 4U;
constexpr unsigned kFall = 1U << 5U;

}  // namespace

void TouchProbe::take(std::uint8_t function) noexcept {
  // When the probe or one of its edges is switched off, the stored position is cleared.
  has_rise_ = has_rise_ && (function & kSwitchedOn) != 0 && (function & kRise) != 0;
  has_fall_ = has_fall_ && (function & kSwitchedOn) != 0 && (function & kFall) != 0;
  function_ = function;
}

void TouchProbe::store(double at, bool rising) noexcept {
  const bool again = (function_ & kEveryTime) != 0;
  if (rising && (function_ & kRise) != 0 && (again || !has_rise_)) {
    has_rise_ = true;
    rise_ = at;
  }
  if (!rising && (function_ & kFall) != 0 && (again || !has_fall_)) {
    has_fall_ = true;
    fall_ = at;
  }
}

void TouchProbe::step(const ProbeStep& step) noexcept {
  if ((function_ & kSwitchedOn) == 0 || step.before == step.now) {
    return;
  }
  if ((function_ & kMark) != 0) {
    if (const auto at = mark_passed(step.mark_at, step.before, step.now)) {
      store(*at, true);
      store(*at, false);
    }
    return;
  }
  const bool was = step.input_at && step.before >= *step.input_at;
  const bool is = step.input_at && step.now >= *step.input_at;
  if (was != is) {
    store(*step.input_at, is);
  }
}

std::uint8_t TouchProbe::status() const noexcept {
  constexpr unsigned kStoredRise = 1U << 1U;
  constexpr unsigned kStoredFall = 1U << 2U;
  return static_cast<std::uint8_t>((function_ & kSwitchedOn) | (has_rise_ ? kStoredRise : 0U) |
                                   (has_fall_ ? kStoredFall : 0U));
}

}  // namespace indurop::io
