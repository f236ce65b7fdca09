// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/deployment_files.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/read_file.h"

namespace indurop::deploy {
namespace {

using testing::HasSubstr;

class CloneFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("deployment_files_test." + std::to_string(::getpid()));
};

TEST_F(CloneFile, Replaces_what_is_there) {
  for (const std::string& text : {std::string(300'000, 'x'), std::string("short"), std::string()}) {
    const auto to = file("to", "older and longer than the new content");
    ASSERT_TRUE(clone_file(file("from", text), to).ok());
    EXPECT_EQ(*base::read_file(to), text);
  }
}

TEST_F(CloneFile, Names_the_cause) {
  const auto full = clone_file(file("from", std::string(300'000, 'x')), "/dev/full");
  ASSERT_FALSE(full.ok());
  EXPECT_THAT(full.error().text, HasSubstr("cannot write /dev/full: No space left on device"));
  const auto absent = clone_file("/nowhere/from", file("to", ""));
  ASSERT_FALSE(absent.ok());
  EXPECT_THAT(absent.error().text, HasSubstr("cannot read /nowhere/from: No such file or directory"));
}

}  // namespace
}  // namespace indurop::deploy
