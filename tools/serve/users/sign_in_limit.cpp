// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/users/sign_in_limit.h"

#include <algorithm>

#include "tools/serve/door/connection_limits.h"

namespace indurop::serve {

std::optional<SignInLimit::Id> SignInLimit::begin(const std::string& address, const std::string& user,
                                                  std::int64_t now_ns) {
  const std::string key = limits_key(address);
  const std::lock_guard guard(lock_);
  std::erase_if(attempts_,
                [now_ns](const auto& one) { return one.second.until_ns != 0 && one.second.until_ns <= now_ns; });
  const auto of_address =
      std::count_if(attempts_.begin(), attempts_.end(), [&](const auto& one) { return one.second.key == key; });
  const auto of_user = std::count_if(attempts_.begin(), attempts_.end(),
                                     [&](const auto& one) { return one.second.key == key && one.second.user == user; });
  if (static_cast<std::size_t>(of_address) >= kMostOfAddress || static_cast<std::size_t>(of_user) >= kMostOfUser) {
    return std::nullopt;
  }
  attempts_[++last_] = {key, user, 0};
  return last_;
}

void SignInLimit::end(Id attempt, bool wrong, std::int64_t now_ns) {
  const std::lock_guard guard(lock_);
  const auto found = attempts_.find(attempt);
  if (found == attempts_.end()) {
    return;
  }
  const std::int64_t delay_ns = wrong ? wrong_.wrong(found->second.key, now_ns).delay_ns : 0;
  if (delay_ns == 0) {
    attempts_.erase(found);
  } else {
    found->second.until_ns = now_ns + delay_ns;
  }
}

}  // namespace indurop::serve
