// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/wrong_tokens.h"

#include <algorithm>

#include "tools/serve/door/connection_limits.h"

namespace indurop::serve {

WrongTokens::One& WrongTokens::of(const std::string& key, std::int64_t now_ns) {
  std::erase_if(all_, [now_ns](const auto& one) { return now_ns - one.second.last_ns > kWindowNs; });
  if (all_.size() >= kMostAddresses && !all_.contains(key)) {
    all_.erase(std::min_element(all_.begin(), all_.end(),
                                [](const auto& a, const auto& b) { return a.second.last_ns < b.second.last_ns; }));
  }
  return all_[key];
}

WrongTokens::Verdict WrongTokens::wrong(const std::string& address, std::int64_t now_ns) {
  One& one = of(limits_key(address), now_ns);
  const bool first = one.count == 0;
  ++one.count;
  ++one.not_noted;
  one.last_ns = now_ns;
  Verdict verdict;
  if (one.count > kAtOnce) {
    constexpr std::uint64_t kMostSteps = 10;
    verdict.delay_ns = std::min(kMostDelayNs, kFirstDelayNs << std::min(one.count - kAtOnce - 1, kMostSteps));
  }
  if ((first || now_ns - one.noted_ns > kWindowNs) && notes_.take(now_ns)) {
    one.noted_ns = now_ns;
    verdict.note = one.not_noted;
    one.not_noted = 0;
  }
  return verdict;
}

}  // namespace indurop::serve
