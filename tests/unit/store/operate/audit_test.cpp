// SPDX-License-Identifier: Apache-2.0
#include "store/operate/audit.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace indurop::operate {
namespace {

TEST(Audit, Keeps_what_was_written_and_shows_the_newest) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / ("audit" + std::to_string(getpid()));
  const auto file = folder / "deep/audit.jsonl";
  EXPECT_TRUE(read_audit(file, 10).empty());
  for (const char* what : {"a=1", "b=\"2\n\"", "c=3"}) {
    ASSERT_EQ(append_audit(file, {5, "ana", "127.0.0.1", "local", "set", what, "done", "why"}), "");
  }
  const auto last = read_audit(file, 2);
  ASSERT_EQ(last.size(), 2U);
  EXPECT_EQ(last[0].what, "b=\"2\n\"");
  EXPECT_EQ(last[1].what, "c=3");
  EXPECT_EQ(last[1].who, "ana");
  struct stat info {};
  ASSERT_EQ(stat(file.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0600U);
  std::filesystem::remove_all(folder);
}

TEST(Audit, Long_texts_do_not_push_other_entries_out) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / ("audit_long" + std::to_string(getpid()));
  const auto file = folder / "audit.jsonl";
  ASSERT_EQ(append_audit(file, {5, "ana", "127.0.0.1", "local", "set", "first", "done", "why"}), "");
  std::string text(kMaxAuditText - 1, 'x');
  while (text.size() < 250'000) {
    text += "\u00e9";
  }
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(append_audit(file, {5, "ana", "127.0.0.1", "local", "set", text, text, text}), "");
  }
  const auto all = read_audit(file, 1000);
  ASSERT_EQ(all.size(), 101U);
  EXPECT_EQ(all[0].what, "first");
  const std::string kept =
      std::string(kMaxAuditText - 1, 'x') + "... (" + std::to_string(text.size()) + " bytes in all)";
  EXPECT_EQ(all[100].what, kept) << "no part of a character";
  EXPECT_EQ(all[100].reason, kept);
  EXPECT_LT(std::filesystem::file_size(file), 2'000'000U);
  std::filesystem::remove_all(folder);
}

TEST(Audit, Says_why_it_cannot_be_kept) {
  EXPECT_NE(append_audit("/proc/nowhere/audit.jsonl", {}), "");
}

TEST(Audit, Passes_over_lines_that_are_none) {
  EXPECT_FALSE(parse_audit_line("{"));
  EXPECT_FALSE(parse_audit_line("{}"));
  EXPECT_TRUE(parse_audit_line(R"({"wall_ns":1,"action":"set","more":[]})"));
}

}  // namespace
}  // namespace indurop::operate
