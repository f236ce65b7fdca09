// SPDX-License-Identifier: Apache-2.0
#include "node/modules/file_mark.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace indurop::node {
namespace {

namespace fs = std::filesystem;

fs::path made_folder() {
  const fs::path folder = fs::path(testing::TempDir()) / ("file_mark_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(FileMark, Is_that_of_one_file_with_one_content) {
  const fs::path folder = made_folder();
  const fs::path file = folder / "a.exe";
  EXPECT_EQ(mark_of(file), FileMark{});
  std::ofstream(file) << "first";
  const FileMark first = mark_of(file);
  EXPECT_NE(first, FileMark{});
  EXPECT_EQ(mark_of(file), first);
  std::ofstream(file, std::ios::app) << ", and more";
  EXPECT_NE(mark_of(file), first) << "written";
  std::ofstream(folder / "b.exe") << "first";
  fs::rename(folder / "b.exe", file);
  EXPECT_NE(mark_of(file), first) << "replaced";
}

TEST(FileMark, Says_whether_a_process_executes_it) {
  const fs::path folder = made_folder();
  const fs::path own = fs::read_symlink("/proc/self/exe");
  EXPECT_TRUE(executes(::getpid(), own, mark_of(own)));
  const fs::path copy = folder / "copy.exe";
  fs::copy_file(own, copy);
  EXPECT_FALSE(executes(::getpid(), copy, mark_of(copy)));
  const fs::path script = folder / "script";
  std::ofstream(script) << "#!/bin/sh\n";
  EXPECT_TRUE(executes(::getpid(), script, mark_of(script))) << "another program executes it";
}

}  // namespace
}  // namespace indurop::node
