// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/black_box.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace indurop::deploy {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class BlackBoxTest : public ::testing::Test {
 protected:
  BlackBoxTest() : folder_(std::filesystem::temp_directory_path() / ("black_box_" + std::to_string(::getpid()))) {}
  ~BlackBoxTest() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.insert(entry.path().filename());
    }
    return names;
  }
  std::filesystem::path folder_;
};

TEST_F(BlackBoxTest, The_newest_are_kept) {
  std::filesystem::create_directories(folder_);
  for (const char* old : {"20250101T000000.000Z.run", "20250102T000000.000Z.run"}) {
    std::ofstream(folder_ / old) << "old";
  }
  const BlackBox sut(folder_, "black_box_test_none");
  std::set<std::string> all = files();
  while (all.size() < BlackBox::kKept) {
    EXPECT_THAT(sut.keep(), StartsWith("its black box is in " + folder_.string()));
    all = files();
  }
  EXPECT_TRUE(all.contains("20250101T000000.000Z.run"));
  while (files().contains("20250102T000000.000Z.run")) {  // one a millisecond at most
    (void)sut.keep();
  }
  EXPECT_EQ(files().size(), BlackBox::kKept);
}

// The clock was ahead once, or it begins in 1970 since its battery is empty.
TEST_F(BlackBoxTest, The_last_one_is_kept_whatever_the_clock_was_before) {
  std::filesystem::create_directories(folder_);
  for (int day = 1; day < 10; ++day) {
    std::ofstream(folder_ / ("2999010" + std::to_string(day) + "T000000.000Z.run")) << "ahead";
  }
  const BlackBox sut(folder_, "black_box_test_none");
  const std::string said = sut.keep();
  const std::string file = said.substr(said.find('/'));
  EXPECT_TRUE(std::filesystem::exists(file)) << said;
  const std::set<std::string> all = files();
  EXPECT_EQ(all.size(), BlackBox::kKept);
  EXPECT_FALSE(all.contains("29990101T000000.000Z.run"));
  EXPECT_TRUE(all.contains("29990109T000000.000Z.run"));
}

TEST_F(BlackBoxTest, A_folder_that_cannot_be_created_is_reported) {
  const BlackBox sut("/proc/none", "black_box_test_none");
  EXPECT_THAT(sut.keep(), HasSubstr("could not be kept: cannot write /proc/none/"));
}

}  // namespace
}  // namespace indurop::deploy
