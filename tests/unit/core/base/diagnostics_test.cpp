// SPDX-License-Identifier: Apache-2.0
#include "core/base/diagnostics.h"

#include <gtest/gtest.h>

#include "core/base/source_line.h"

namespace indurop::base {
namespace {

using Severity = Diagnostic::Severity;

TEST(Diagnostics, Are_printed_as_editors_read_them) {
  EXPECT_EQ(to_string({Severity::Error, "m.xml", {3, 7}, "no"}), "m.xml:3:7: error: no");
  EXPECT_EQ(to_string({Severity::Warning, "m.xml", {3, 0}, "no"}), "m.xml:3: warning: no");
  EXPECT_EQ(to_string({Severity::Note, "m.xml", {}, "no"}), "m.xml: note: no");
  EXPECT_EQ(to_string({Severity::Error, "", {}, "no"}), "error: no");
  EXPECT_EQ(to_string({Severity::Error, "", {}, "no"}, "glb2idl"), "glb2idl: error: no");
  EXPECT_EQ(to_string({Severity::Error, "a", {1, 1}, "no", "rung 3"}), "a:1:1: error: rung 3: no");
  EXPECT_EQ(to_string({Severity::Error, "a\nb", {}, "no\x1b"}), "a b: error: no ");
}

TEST(Diagnostics, Are_printed_with_their_pictures) {
  Diagnostic one{Severity::Error, "a", {1, 5}, "no"};
  one.picture = picture_of_line("int xyz;", 5, 3);
  EXPECT_EQ(to_text({one, one}),
            "a:1:5: error: no\n    int xyz;\n        ^~~\na:1:5: error: no\n    int xyz;\n        ^~~\n");
}

TEST(Diagnostics, The_same_at_the_same_place_is_kept_once) {
  std::vector<Diagnostic> found;
  Diagnostics sut("a", found);
  sut.error({1, 1}, "no");
  sut.error({1, 1}, "no");
  sut.error({1, 2}, "no");
  sut.add({Severity::Error, "b", {1, 1}, "no"});
  EXPECT_EQ(found.size(), 3U);
  EXPECT_EQ(sut.errors(), 3U);
}

TEST(Diagnostics, Beyond_the_limit_they_are_counted_and_summed_up) {
  std::vector<Diagnostic> found;
  Diagnostics sut("a", found, 2);
  for (int line = 1; line <= 3; ++line) {
    EXPECT_FALSE(sut.full());
    sut.error({line, 1}, "no");
  }
  sut.warning({9, 1}, "hm");
  EXPECT_TRUE(sut.full());
  EXPECT_EQ(sut.errors(), 3U);
  ASSERT_EQ(found.size(), 3U) << "two errors, and the warning";
  sut.add_summary(found);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(to_string(found.back()), "a: error: too many errors, the first 2 are shown");
}

TEST(Diagnostics, Warnings_alone_are_no_failure) {
  std::vector<Diagnostic> found;
  Diagnostics sut("", found);
  sut.warning({1, 1}, "hm");
  sut.note({1, 1}, "see");
  EXPECT_FALSE(sut.failed());
  EXPECT_FALSE(has_error(found));
}

std::string lines_of(const std::vector<Diagnostic>& list) {
  std::string out;
  for (const Diagnostic& one : list) {
    out += one.file + std::to_string(one.place.line) + " ";
  }
  return out;
}

TEST(Diagnostics, Of_one_file_are_sorted_by_place_with_those_without_last) {
  std::vector<Diagnostic> list{
      {Severity::Error, "a", {}, ""}, {Severity::Error, "a", {7, 1}, ""}, {Severity::Error, "a", {2, 1}, ""}};
  sort_by_place(list);
  EXPECT_EQ(lines_of(list), "a2 a7 a0 ");
}

TEST(Diagnostics, Of_several_files_are_sorted_file_by_file) {
  std::vector<Diagnostic> list{{Severity::Error, "b", {7, 1}, ""},
                               {Severity::Error, "a", {9, 1}, ""},
                               {Severity::Error, "", {}, ""},
                               {Severity::Error, "a", {2, 1}, ""},
                               {Severity::Error, "b", {3, 1}, ""}};
  auto named = list;
  sort_by_file(list);
  EXPECT_EQ(lines_of(list), "b3 b7 a2 a9 0 ");
  sort_by_file(named, {"", "a", "b"});
  EXPECT_EQ(lines_of(named), "0 a2 a9 b3 b7 ");
}

}  // namespace
}  // namespace indurop::base
