// SPDX-License-Identifier: Apache-2.0
#include "scheduler/retirement.h"

namespace indurop::scheduler {

void Retirement::close(const Schedule& next, std::uint64_t watchdog_passes) {
  closed_ = true;
  releases_.clear();
  for (const auto& band : next.bands()) {
    releases_.push_back(band->released());
  }
  passes_ = watchdog_passes;
}

bool Retirement::is_over(const Schedule& next, std::uint64_t watchdog_passes, bool has_watchdog) const noexcept {
  for (std::size_t i = 0; i < releases_.size(); ++i) {
    if (!next.bands()[i]->has_done(releases_[i])) {
      return false;
    }
  }
  return !has_watchdog || watchdog_passes >= passes_ + 2;
}

void Retirement::end() noexcept {
  schedule_.reset();
  closed_ = false;
}

}  // namespace indurop::scheduler
