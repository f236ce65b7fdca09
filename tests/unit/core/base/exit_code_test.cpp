// SPDX-License-Identifier: Apache-2.0
#include "core/base/exit_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace indurop {
namespace {

TEST(ExitCode, The_list_is_in_order_and_names_everything_once) {
  EXPECT_TRUE(std::is_sorted(kExitCodes.begin(), kExitCodes.end(),
                             [](const ExitCode& a, const ExitCode& b) { return a.value < b.value; }));
  std::set<int> values;
  std::set<std::string_view> names;
  for (const ExitCode& code : kExitCodes) {
    EXPECT_TRUE(values.insert(code.value).second) << code.value;
    EXPECT_TRUE(names.insert(code.name).second) << code.name;
    EXPECT_FALSE(code.text.empty());
    EXPECT_EQ(code.text.find('\n'), std::string_view::npos);
  }
  EXPECT_EQ(kInterrupted, 128 + SIGINT);
  EXPECT_EQ(kTerminated, 128 + SIGTERM);
}

TEST(ExitCode, The_documentation_has_the_same_list) {
  std::vector<std::string> expected;
  for (const ExitCode& code : kExitCodes) {
    expected.push_back("| " + std::to_string(code.value) + " | " + std::string(code.text) + " |");
  }
  std::ifstream in(INDUROP_SOURCE_DIR "/docs/cli.md");
  ASSERT_TRUE(in);
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("| exit code |", 0) == 0) {
      inside = true;
    } else if (inside && line.empty()) {
      break;
    } else if (inside && line.rfind("|---", 0) != 0) {
      line.erase(std::remove(line.begin(), line.end(), '`'), line.end());
      found.push_back(line);
    }
  }
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace indurop
