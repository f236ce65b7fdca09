// SPDX-License-Identifier: Apache-2.0
// Somebody without rights, for what root could not be refused.

#pragma once

#include <unistd.h>

namespace indurop::test {

// Reads what everybody may read.
inline constexpr uid_t kNobody = 65534;

// The user to run a program as that must not have root's rights: the one of the test if it has none.
inline uid_t nobody_instead_of_root() {
  return ::geteuid() == 0 ? kNobody : static_cast<uid_t>(-1);
}

// Becomes nobody for good if this is root; else stays the same user. False: this root cannot.
inline bool become_nobody() {
  return ::setgid(kNobody) == 0 && ::setuid(kNobody) == 0;
}

// What happens during its life happens without root's rights. For tests with one thread.
class WithoutRoot {
 public:
  WithoutRoot() : root_(::geteuid() == 0), held_(!root_ || ::seteuid(kNobody) == 0) {}
  WithoutRoot(const WithoutRoot&) = delete;
  WithoutRoot& operator=(const WithoutRoot&) = delete;
  ~WithoutRoot() {
    if (root_ && held_ && ::seteuid(0) != 0) {
      ::_exit(1);
    }
  }
  // False: this root cannot become anybody else.
  [[nodiscard]] bool held() const noexcept { return held_; }

 private:
  bool root_;
  bool held_;
};

}  // namespace indurop::test
