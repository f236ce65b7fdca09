// SPDX-License-Identifier: Apache-2.0
// How many attempts to sign in may be under way for one address, and for one user of it, so that guesses of one client
// do not keep others from signing in. A wrong attempt stays under way for the time by which its reply is delayed, also
// if its client does not wait for it. Thread-safe.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "tools/serve/door/wrong_tokens.h"

namespace indurop::serve {

class SignInLimit {
 public:
  static constexpr std::size_t kMostOfAddress = 16;
  static constexpr std::size_t kMostOfUser = 4;  // from one address
  using Id = std::uint64_t;

  // Returns the number of the attempt, or nothing if too many are under way. `user`: empty: one who does not exist.
  std::optional<Id> begin(const std::string& address, const std::string& user, std::int64_t now_ns);
  void end(Id attempt, bool wrong, std::int64_t now_ns);

 private:
  struct Attempt {
    std::string key;  // of the address
    std::string user;
    std::int64_t until_ns = 0;  // 0: its password is not verified yet
  };

  std::mutex lock_;
  Id last_ = 0;
  std::map<Id, Attempt> attempts_;
  WrongTokens wrong_;
};

}  // namespace indurop::serve
