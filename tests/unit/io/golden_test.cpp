// SPDX-License-Identifier: Apache-2.0
// Whole ioconfig.xml files against what is said about them, one folder each with in.xml and expected.err. The variables
// are those of cell.glb. INDUROP_UPDATE_GOLDEN=1 writes the expectations instead.

#include <gmock/gmock.h>
#include <indurop/indurop.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <indurop/generated.h>

#include "cell_schema.h"
#include "deploy/io_config.h"

namespace indurop::io {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(GOLDEN_IO)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class IoGolden : public ::testing::TestWithParam<std::string> {};

TEST_P(IoGolden, Says_what_is_expected) {
  const std::filesystem::path folder = std::filesystem::path(GOLDEN_IO) / GetParam();
  deploy::ReadIo read = deploy::read_io_config_text(contents(folder / "in.xml"), "in.xml");
  const schema::Schema schema = cell_schema();
  static_cast<void>(deploy::bind_io(read.config, schema, read.diagnostics));
  std::string said;
  for (const deploy::Diagnostic& diagnostic : read.diagnostics) {
    said += deploy::to_string(diagnostic) + "\n";
  }
  if (std::getenv("INDUROP_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(folder / "expected.err") << said;
  }
  EXPECT_EQ(said, contents(folder / "expected.err"));
}

INSTANTIATE_TEST_SUITE_P(Cases, IoGolden, ::testing::ValuesIn(cases()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace indurop::io
