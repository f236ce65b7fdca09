// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/boxes_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "history/recorder/boxes.h"

namespace indurop::deploy {
namespace {

class Boxes_text : public testing::Test {
 protected:
  Boxes_text() {
    ::setenv("INDUROP_STATE_DIR", folder_.c_str(), 1);
    std::filesystem::create_directories(recorder::box_folder("a"));
  }
  ~Boxes_text() override {
    ::unsetenv("INDUROP_STATE_DIR");
    std::filesystem::remove_all(folder_);
  }
  static void write(const std::filesystem::path& file) { std::ofstream(file) << "no recording"; }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("boxes_text_test." + std::to_string(::getpid()));
};

TEST_F(Boxes_text, Gives_what_is_in_the_list_and_nothing_else) {
  const auto boxes = recorder::box_folder("a");
  write(boxes / "20261122-100000-000.mcap");
  write(boxes / "notes.txt");
  write(boxes.parent_path() / "secret.mcap");
  std::filesystem::create_directories(boxes / "deeper.mcap");
  EXPECT_EQ(box_file("a", "20261122-100000-000.mcap"), boxes / "20261122-100000-000.mcap");
  for (const char* name : {"", ".", "..", "notes.txt", "../secret.mcap", "secret.mcap", "deeper.mcap",
                           "deeper.mcap/../20261122-100000-000.mcap", "/etc/passwd"}) {
    EXPECT_FALSE(box_file("a", name)) << name;
  }
  EXPECT_FALSE(box_file("missing", "20261122-100000-000.mcap"));
}

TEST_F(Boxes_text, Damaged_ones_are_in_the_list_with_what_is_wrong) {
  write(recorder::box_folder("a") / "20261122-100000-000.mcap");
  const std::string text = boxes_text("a");
  EXPECT_NE(text.find("20261122-100000-000.mcap"), std::string::npos) << text;
  EXPECT_NE(text.find("this is not a recording"), std::string::npos) << text;
  EXPECT_EQ(boxes_text("missing"), R"({"boxes":[]})");
}

}  // namespace
}  // namespace indurop::deploy
