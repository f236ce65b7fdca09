// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/steps.h"

#include <fmt/format.h>

namespace indurop::fmi {

std::string Steps::problem_of(double at, double size) const {
  const double tolerance = kTolerance * period_;
  if (!std::isfinite(at) || !std::isfinite(size) || size <= 0) {
    return fmt::format("a step of {} s from {} s is not possible: it has to be longer than 0", size, at);
  }
  if (std::abs(at - now_) > tolerance) {
    return fmt::format("the step begins at {} s, but the last one ended at {} s: time neither jumps nor goes back", at,
                       now_);
  }
  if (stop_ && at + size > *stop_ + tolerance) {
    return fmt::format("the step ends at {} s, beyond the stop time of {} s", at + size, *stop_);
  }
  if ((at + size - start_) / period_ > kMostTicks) {
    return fmt::format("a step to {} s is too far", at + size);
  }
  return {};
}

}  // namespace indurop::fmi
