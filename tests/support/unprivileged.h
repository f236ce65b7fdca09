// SPDX-License-Identifier: Apache-2.0
// A user without rights, for tests of what root is never refused.

#pragma once

#include <unistd.h>

namespace indurop::test {

// Reads what everybody may read.
inline constexpr uid_t kUnprivileged = 65534;

// The user to run a program as that must not have root's rights: the one of the test if it has none.
inline uid_t unprivileged_instead_of_root() {
  return ::geteuid() == 0 ? kUnprivileged : static_cast<uid_t>(-1);
}

// Gives up root for good if this is root, otherwise changes nothing. False: this root cannot.
inline bool become_unprivileged() {
  return ::setgid(kUnprivileged) == 0 && ::setuid(kUnprivileged) == 0;
}

// What happens during its life happens without root's rights. For tests with one thread.
class WithoutRoot {
 public:
  WithoutRoot() : root_(::geteuid() == 0), held_(!root_ || ::seteuid(kUnprivileged) == 0) {}
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
