// SPDX-License-Identifier: Apache-2.0
// The Reference-FMUs of the FMI project against the results that it publishes with them, where INDUROP_FMI_DATA has
// them: reference/BouncingBall2.fmu, BouncingBall3.fmu (FMI 2 and 3) and BouncingBall_out.csv.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <indurop/testing.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/read_file.h"
#include "tests/integration/fmi/model.h"

namespace indurop::fmi {
namespace {

using irp::testing::Plant;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    cells.push_back(cell);
  }
  return cells;
}

// Each row is that of a tick; of several rows at one time, the last one is after an event.
void expect_results(const std::string& fmu, const std::string& results, double period) {
  const Model model(fmt::format(R"(<device name="m" driver="fmu" file="{}" variables="m"/>)", fmu), {}, {},
                    fmt::format("{}ms", std::lround(period * 1e3)));
  Plant plant(model.file());
  std::istringstream lines(base::read_file(results).value());
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) {
    rows.push_back(cells_of(line));
    if (rows.size() > 1 && rows.back()[0] == rows[rows.size() - 2][0]) {
      rows.erase(rows.end() - 2);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    plant.step();
    if (plant.module("model").faulted) {
      EXPECT_THAT(plant.module("model").last_fault, ::testing::HasSubstr("the FMU has ended the simulation"));
      EXPECT_EQ(i + 1, rows.size()) << "it ends in its last step";
      return;
    }
    ASSERT_NEAR(std::stod(rows[i][0]), static_cast<double>(i) * period, 1e-9);
    for (std::size_t k = 1; k < names.size(); ++k) {
      ASSERT_EQ(plant.get<double>("m::" + names[k]), std::stod(rows[i][k])) << names[k] << " at " << rows[i][0] << " s";
    }
  }
}

TEST(FmuReference, Has_the_published_results) {
  const char* const data = std::getenv("INDUROP_FMI_DATA");  // NOLINT(concurrency-mt-unsafe): read only
  if (data == nullptr) {
    GTEST_SKIP() << "INDUROP_FMI_DATA names no folder with reference/";
  }
  for (const int version : {2, 3}) {
    for (const auto& [name, period] :
         {std::pair<std::string, double>("BouncingBall", 0.01), std::pair<std::string, double>("Dahlquist", 0.1),
          std::pair<std::string, double>("VanDerPol", 0.01), std::pair<std::string, double>("Stair", 0.2)}) {
      SCOPED_TRACE(fmt::format("{}, FMI {}", name, version));
      const std::string folder = fmt::format("{}/reference/{}", data, name);
      expect_results(fmt::format("{}{}.fmu", folder, version), folder + "_out.csv", period);
    }
  }
}

}  // namespace
}  // namespace indurop::fmi
