// SPDX-License-Identifier: Apache-2.0
// Whole configurations against what is expected of them, one folder each. Files of a case that exist are compared:
// expected.err (diagnostics of reading and of the schedule), .table, .json, .csv, .svg, .why, and .adjusted (the table
// with
// --adjust). INDUROP_UPDATE_GOLDEN=1 writes them instead.

#include <gmock/gmock.h>

#include <fstream>

#include "config/plan/plan.h"
#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"
#include "tests/golden/golden.h"

namespace indurop::config {
namespace {

class Golden : public testing::TestWithParam<std::string> {
 protected:
  void compare(const std::string& name, const std::string& sut) {
    const std::filesystem::path file = folder() / ("expected." + name);
    if (golden::updating()) {
      if (std::filesystem::exists(file) || !may_be_missing(name)) {
        std::ofstream(file, std::ios::binary) << sut;
      }
      return;
    }
    if (std::filesystem::exists(file)) {
      EXPECT_EQ(sut, golden::slurp(file)) << file;
    } else {
      EXPECT_TRUE(may_be_missing(name)) << file << " is missing";
    }
  }
  static bool may_be_missing(const std::string& name) { return name == "svg" || name == "csv" || name == "why"; }
  template <class Kind>
  void run();
  [[nodiscard]] static std::filesystem::path folder() { return std::filesystem::path(GOLDEN_CONFIG) / GetParam(); }
};

ReadResult read(const std::string& xml, const Config& /*kind*/) {
  return read_config_text(xml, "in.xml");
}
ReadPlant read(const std::string& xml, const Plant& /*kind*/) {
  return read_plant_text(xml, "in.xml");
}
Config& content(ReadResult& read) {
  return read.config;
}
Plant& content(ReadPlant& read) {
  return read.plant;
}
CheckResult check_golden(Config& config, const CheckOptions& options) {
  return check_config(config, options);
}
PlantCheck check_golden(Plant& plant, const CheckOptions& options) {
  return check_plant(plant, options);
}

std::string text(const std::vector<base::Diagnostic>& diagnostics) {
  std::string text;
  for (const base::Diagnostic& d : diagnostics) {
    text += base::to_string(d) + "\n";
  }
  return text;
}

// `Kind`: Config or Plant.
template <class Kind>
void Golden::run() {
  auto read_file = read(golden::slurp(folder() / "in.xml"), Kind{});
  if (!read_file.ok()) {
    compare("err", text(read_file.diagnostics));
    return;
  }
  Kind& kind = content(read_file);
  const auto checked = check_golden(kind, {.files = false, .adjust = false, .machine = false});
  compare("err", text(read_file.diagnostics) + text(checked.diagnostics));
  if (!checked.ok()) {
    const auto adjusted = check_golden(kind, {.files = false, .adjust = true, .machine = false});
    compare("adjusted", plan_table(kind, adjusted));
    return;
  }
  compare("table", plan_table(kind, checked));
  compare("json", plan_json(kind, checked));
  compare("csv", plan_csv(kind, checked));
  compare("svg", plan_svg(kind, checked));
  compare("why", plan_why(kind, checked));
}

TEST_P(Golden, Is_as_expected) {
  if (is_plant_file(folder() / "in.xml")) {
    run<Plant>();
  } else {
    run<Config>();
  }
}

INSTANTIATE_TEST_SUITE_P(Deploy, Golden, testing::ValuesIn(golden::cases(GOLDEN_CONFIG, "in.xml")),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::config
