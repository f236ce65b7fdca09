// SPDX-License-Identifier: Apache-2.0
// Lines that differ between two texts, against the program that everybody compares with (diff), over random texts.

#include "tools/client/board/deployment_difference.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>

namespace indurop::tools {
namespace {

std::string random_text(std::mt19937& random) {
  std::string text;
  for (auto lines = random() % 20; lines > 0; --lines) {
    text += std::string("line ") + static_cast<char>('a' + random() % 5) + "\n";
  }
  return text;
}

std::string without(const base::Json& rows, const char* change) {
  std::string text;
  for (const base::Json& row : rows.values()) {
    text += row["change"].text() != change ? *row["text"].text() + "\n" : "";
  }
  return text;
}

// Changed lines as `diff` counts them. The unified form is the one that every diff knows.
std::size_t counted_by_diff(const std::string& before, const std::string& after) {
  const auto folder = std::filesystem::temp_directory_path() / ("difference_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a") << before;
  std::ofstream(folder / "b") << after;
  const std::string command =
      "diff -d -u " + (folder / "a").string() + " " + (folder / "b").string() + " | grep -c '^[-+]line'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::size_t count = 0;
  EXPECT_EQ(std::fscanf(pipe.get(), "%zu", &count), 1);
  std::filesystem::remove_all(folder);
  return count;
}

TEST(DeploymentDifference, Is_as_small_as_that_of_diff_and_leads_from_one_to_the_other) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const std::string before = random_text(random);
    const std::string after = random_text(random);
    const base::Json rows = lines_between(before, after);
    std::size_t changed = 0;
    for (const base::Json& row : rows.values()) {
      changed += row["change"].text() != "same" ? 1U : 0U;
    }
    ASSERT_EQ(changed, counted_by_diff(before, after)) << before << "---\n" << after;
    if (before.size() <= 3 * 7 && after.size() <= 3 * 7 && changed > 0) {  // short enough for all of it to be shown
      EXPECT_EQ(without(rows, "added"), before);
      EXPECT_EQ(without(rows, "removed"), after);
    }
  }
}

TEST(DeploymentDifference, Leaves_out_what_is_the_same_but_for_three_lines_around) {
  std::string before;
  for (int i = 0; i < 100; ++i) {
    before += "line " + std::to_string(i) + "\n";
  }
  std::string after = before;
  after.replace(after.find("line 50\n"), 8, "line fifty\n");
  const base::Json rows = lines_between(before, after);
  ASSERT_EQ(rows.values().size(), 8U);
  EXPECT_EQ(rows.values()[0]["text"].text(), "line 47");
  EXPECT_EQ(rows.values()[3]["change"].text(), "removed");
  EXPECT_EQ(rows.values()[4]["text"].text(), "line fifty");
  EXPECT_TRUE(lines_between(before, before).values().empty());
}

}  // namespace
}  // namespace indurop::tools
