// SPDX-License-Identifier: Apache-2.0
// Lets a board wait when it opens files of this folder, as if its disk hung: by a preloaded library, for programs that
// are started while this object lives, as long as a file exists.

#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace indurop::test {

class HeldCheck {
 public:
  // `folder`: a part of the paths that are held; `file`: where there is one while they are.
  HeldCheck(const std::string& folder, std::filesystem::path file) : file_(std::move(file)) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    ::setenv("LD_PRELOAD", HELD_OPEN, 1);
#endif
    ::setenv("IRP_TEST_HELD", folder.c_str(), 1);
    ::setenv("IRP_TEST_HELD_WHILE", file_.c_str(), 1);
  }
  ~HeldCheck() {
    for (const char* name : {"LD_PRELOAD", "IRP_TEST_HELD", "IRP_TEST_HELD_WHILE"}) {
      ::unsetenv(name);
    }
    release();
  }
  HeldCheck(const HeldCheck&) = delete;
  HeldCheck& operator=(const HeldCheck&) = delete;

  void hold() const {
    std::ofstream(file_) << "hold\n";
  }
  void release() const {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }

 private:
  std::filesystem::path file_;
};

}  // namespace indurop::test
