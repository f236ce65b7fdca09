// SPDX-License-Identifier: Apache-2.0
// Test boards as network namespaces. Needs root and the ip command.

#pragma once

#include <cstdlib>

#include "boards.h"

namespace indurop::test {

class Lab : public Boards {
 protected:
  Lab() : lab_("mt" + std::to_string(::getpid() % 100'000)) {}
  ~Lab() override {
    if (up_) {
      run("down");
    }
  }
  // False: the test cannot run here.
  bool up(const std::string& boards) {
    up_ = ::geteuid() == 0 && run("up " + boards + " 2>/dev/null") == 0;
    return up_;
  }
  int run(const std::string& words) const {
    return std::system((std::string(LAB_PROGRAM) + " -l " + lab_ + " " + words).c_str());
  }
  const std::string& lab() const { return lab_; }

 private:
  std::string lab_;
  bool up_ = false;
};

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage,readability-identifier-naming): GTEST_SKIP() returns from the test
#define NEEDS_LAB(boards)                                                                    \
  if (!up(boards)) {                                                                         \
    GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)"; \
  }

}  // namespace indurop::test
