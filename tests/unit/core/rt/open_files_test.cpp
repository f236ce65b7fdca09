// SPDX-License-Identifier: Apache-2.0
// Files that started programs do not inherit.

#include "core/rt/open_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace indurop::rt {
namespace {

TEST(OpenFiles, Are_closed_on_exec_but_the_standard_ones) {
  const int opened = ::open("/dev/null", O_RDONLY);
  ASSERT_GT(opened, STDERR_FILENO);
  ASSERT_EQ(::fcntl(opened, F_GETFD) & FD_CLOEXEC, 0);
  close_open_files_on_exec();
  EXPECT_EQ(::fcntl(opened, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
  EXPECT_EQ(::fcntl(STDOUT_FILENO, F_GETFD) & FD_CLOEXEC, 0);
  EXPECT_EQ(::close(opened), 0);
}

}  // namespace
}  // namespace indurop::rt
