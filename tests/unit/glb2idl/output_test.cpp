// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/output.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace indurop::glb2idl {
namespace {

namespace fs = std::filesystem;

class OutputTest : public ::testing::Test {
 protected:
  OutputTest() : folder_(fs::temp_directory_path() / ("glb2idl_output_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~OutputTest() override { fs::remove_all(folder_); }

  static std::string slurp(const fs::path& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return content.str();
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder_), {}));
  }

  fs::path folder_;
};

TEST_F(OutputTest, Creates_folders_and_leaves_nothing_else_behind) {
  EXPECT_EQ(write_file((folder_ / "a/b/c.txt").string(), "text"), "");
  EXPECT_EQ(slurp(folder_ / "a/b/c.txt"), "text");
  EXPECT_EQ(files(), 3U);
}

TEST_F(OutputTest, Unchanged_files_are_not_rewritten) {
  const fs::path path = folder_ / "x";
  ASSERT_EQ(write_file(path.string(), "same"), "");
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(path, old);
  ASSERT_EQ(write_file(path.string(), "same"), "");
  EXPECT_EQ(fs::last_write_time(path), old);
  ASSERT_EQ(write_file(path.string(), "diff"), "");
  EXPECT_NE(fs::last_write_time(path), old);
  EXPECT_EQ(slurp(path), "diff");
}

TEST_F(OutputTest, Says_what_cannot_be_written) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_NE(write_file((folder_ / "file/below").string(), "text"), "");
  fs::create_directories(folder_ / "folder/in_the_way");
  EXPECT_NE(write_file((folder_ / "folder").string(), "text"), "");
  EXPECT_EQ(files(), 3U) << "a temporary file is left";
}

TEST_F(OutputTest, Writes_all_below_the_folder) {
  EXPECT_EQ(write_all((folder_ / "out").string(), {{"a.idl", "1"}, {"indurop/generated.h", "2"}}), "");
  EXPECT_EQ(slurp(folder_ / "out/indurop/generated.h"), "2");
}

TEST(Depfile, Escapes_what_make_would_misread) {
  EXPECT_EQ(depfile_text("out/x.h", {"/a b/c$d#e.glb"}), "out/x.h: \\\n  /a\\ b/c$$d\\#e.glb\n");
}

}  // namespace
}  // namespace indurop::glb2idl
