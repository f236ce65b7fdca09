// SPDX-License-Identifier: Apache-2.0
// The names of files that a command hands to another process.

#include "tools/cli/command/config_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace indurop::tools {
namespace {

class AbsoluteName : public testing::Test {
 protected:
  AbsoluteName() { std::filesystem::create_directory(folder); }
  ~AbsoluteName() override {
    std::filesystem::current_path(before);
    std::filesystem::remove_all(folder);
  }
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder = std::filesystem::canonical(std::filesystem::temp_directory_path()) /
                                       ("config_file_" + std::to_string(::getpid()));
};

TEST_F(AbsoluteName, Begins_at_the_root) {
  std::filesystem::current_path(folder);
  EXPECT_EQ(absolute_name("./a/../press.so").value(), (folder / "press.so").string());
  EXPECT_EQ(absolute_name("/lib/press.so").value(), "/lib/press.so");
}

TEST_F(AbsoluteName, Needs_the_current_folder_for_a_relative_name) {
  std::filesystem::current_path(folder);
  std::filesystem::remove(folder);
  const auto sut = absolute_name("press.so");
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().text, "press.so: the current folder does not exist any more");
  EXPECT_EQ(absolute_name("/lib/press.so").value(), "/lib/press.so");
}

}  // namespace
}  // namespace indurop::tools
