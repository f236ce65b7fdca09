// SPDX-License-Identifier: Apache-2.0
// Whole configurations against what is expected of them, one folder each. Files of a case that exist are compared:
// expected.err (diagnostics of reading and of the schedule), .table, .json, .csv, .svg, and .adjusted (the table with
// --adjust). INDUROP_UPDATE_GOLDEN=1 writes them instead.

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "deploy/plan.h"
#include "deploy/reader.h"

namespace indurop::deploy {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(GOLDEN_DEPLOY)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Golden : public testing::TestWithParam<std::string> {
 protected:
  void compare(const std::string& name, const std::string& sut) {
    const std::filesystem::path file = folder() / ("expected." + name);
    if (std::getenv("INDUROP_UPDATE_GOLDEN") != nullptr) {
      if (std::filesystem::exists(file) || (name != "svg" && name != "csv")) {
        std::ofstream(file, std::ios::binary) << sut;
      }
      return;
    }
    if (std::filesystem::exists(file)) {
      EXPECT_EQ(sut, contents(file)) << file;
    } else {
      EXPECT_TRUE(name == "svg" || name == "csv") << file << " is missing";
    }
  }
  [[nodiscard]] static std::filesystem::path folder() { return std::filesystem::path(GOLDEN_DEPLOY) / GetParam(); }
};

TEST_P(Golden, Is_as_expected) {
  ReadResult read = read_config_text(contents(folder() / "in.xml"), "in.xml");
  std::string diagnostics;
  for (const Diagnostic& d : read.diagnostics) {
    diagnostics += to_string(d) + "\n";
  }
  if (!read.ok()) {
    compare("err", diagnostics);
    return;
  }
  const CheckResult check = check_config(read.config, {.files = false, .adjust = false});
  for (const Diagnostic& d : check.diagnostics) {
    diagnostics += to_string(d) + "\n";
  }
  compare("err", diagnostics);
  if (!check.ok()) {
    const CheckResult adjusted = check_config(read.config, {.files = false, .adjust = true});
    compare("adjusted", plan_table(read.config, adjusted));
    return;
  }
  compare("table", plan_table(read.config, check));
  compare("json", plan_json(read.config, check));
  compare("csv", plan_csv(read.config, check));
  compare("svg", plan_svg(read.config, check));
}

INSTANTIATE_TEST_SUITE_P(Deploy, Golden, testing::ValuesIn(cases()), [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::deploy
