// SPDX-License-Identifier: Apache-2.0
// Whole ioconfig.xml files against what is said about them, one folder each with in.xml and expected.err. The variables
// are those of cell.glb. INDUROP_UPDATE_GOLDEN=1 writes the expectations instead.

#include <gmock/gmock.h>
#include <indurop/indurop.h>

#include <fstream>

#include <indurop/generated.h>

#include "cell_schema.h"
#include "config/check/io_binding.h"
#include "config/xml/io_reader.h"
#include "tests/golden/golden.h"

namespace indurop::io {
namespace {

class IoGolden : public ::testing::TestWithParam<std::string> {};

TEST_P(IoGolden, Says_what_is_expected) {
  const std::filesystem::path folder = std::filesystem::path(GOLDEN_IO) / GetParam();
  config::ReadIo read = config::read_io_config_text(golden::slurp(folder / "in.xml"), "in.xml");
  const schema::Schema schema = cell_schema();
  static_cast<void>(config::bind_io(read.config, schema, read.diagnostics));
  std::string said;
  for (const base::Diagnostic& diagnostic : read.diagnostics) {
    said += base::to_string(diagnostic) + "\n";
  }
  if (golden::updating()) {
    std::ofstream(folder / "expected.err") << said;
  }
  EXPECT_EQ(said, golden::slurp(folder / "expected.err"));
}

INSTANTIATE_TEST_SUITE_P(Cases, IoGolden, ::testing::ValuesIn(golden::cases(GOLDEN_IO, "in.xml")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace indurop::io
