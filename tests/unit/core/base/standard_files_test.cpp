// SPDX-License-Identifier: Apache-2.0
#include "core/base/standard_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace indurop::base {
namespace {

std::string file_at(int number) {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(number), error).string();
}

// Closes these files first. Ends with 0 if exactly they are /dev/null then, and the next one has none of their numbers.
[[noreturn]] void open_without(std::initializer_list<int> closed) {
  bool good = true;
  for (const int file : {0, 1, 2}) {
    (void)::dup2(::open("/dev/zero", O_RDWR), file);
  }
  for (const int file : closed) {
    (void)::close(file);
  }
  open_standard_files();
  for (const int file : {0, 1, 2}) {
    const bool was_closed = std::find(closed.begin(), closed.end(), file) != closed.end();
    good = good && file_at(file) == (was_closed ? "/dev/null" : "/dev/zero");
  }
  std::_Exit(good && ::open("/dev/zero", O_RDONLY) > 2 ? 0 : 1);
}

TEST(StandardFiles, Are_opened_if_they_are_closed) {
  EXPECT_EXIT(open_without({}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({1}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({2}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0, 2}), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(open_without({0, 1, 2}), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace indurop::base
