// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/source.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace indurop::glb2idl {
namespace {

namespace fs = std::filesystem;

TEST(Sources, Lines_and_columns_count_from_one) {
  Sources sut;
  const auto file = sut.add("a", "a", "ab\n\xc3\xa4x\r\n\nend");
  EXPECT_EQ(sut.place_of({file, 0, 1}).line, 1);
  EXPECT_EQ(sut.place_of({file, 5, 1}).line, 2);
  EXPECT_EQ(sut.place_of({file, 5, 1}).column, 2) << "an umlaut is one character";
  EXPECT_EQ(sut.line_text(file, 2), "\xc3\xa4x");
  EXPECT_EQ(sut.line_text(file, 4), "end");
}

TEST(Reading, Says_why_a_file_cannot_be_read) {
  const fs::path folder = fs::temp_directory_path() / ("glb2idl_source_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  EXPECT_EQ(read_source_file((folder / "none").string()).why, "there is no such file, check the path");
  EXPECT_EQ(read_source_file(folder.string()).why, "it is a directory, name a .glb file");
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(read_source_file((folder / "fifo").string()).why, "it is not a regular file, name a .glb file");
  EXPECT_EQ(read_source_file("/dev/zero").why, "it is not a regular file, name a .glb file");
  std::ofstream(folder / "large") << std::string(kMaxFileBytes + 1, 'x');
  EXPECT_EQ(read_source_file((folder / "large").string()).why, "it is larger than 4 MiB, split it");
  std::ofstream(folder / "good") << "int a;";
  EXPECT_EQ(read_source_file((folder / "good").string()).text, "int a;");
  EXPECT_EQ(read_source_file((folder / "../" / folder.filename() / "good").string()).identity,
            read_source_file((folder / "good").string()).identity);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace indurop::glb2idl
