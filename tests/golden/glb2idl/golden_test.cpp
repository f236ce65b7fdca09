// SPDX-License-Identifier: Apache-2.0
// Each folder beside this file is a case: in.glb and what glb2idl must make of it. After a wanted change of the
// output run the test with INDUROP_UPDATE_GOLDEN=1 and look at the difference.

#include <gtest/gtest.h>

#include <filesystem>

#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"
#include "tests/golden/golden.h"

namespace indurop::glb2idl {
namespace {

namespace fs = std::filesystem;
using golden::expect_file;
using golden::slurp;

// All of several outputs in one text.
std::string joined(const std::vector<Output>& outputs) {
  std::string all;
  for (const Output& output : outputs) {
    all += "---- " + output.path + "\n" + output.text;
  }
  return all;
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, Output_is_as_expected) {
  const fs::path folder = fs::path(GLB2IDL_GOLDEN) / GetParam();
  // Names in messages do not depend on where the tree lies.
  const auto read = [&](const std::string& path) {
    ReadResult got = read_source_file((folder / path).string());
    got.identity = fs::path(path).lexically_normal().string();
    return got;
  };
  const Compilation sut = compile({"in.glb"}, read);

  EXPECT_EQ(sut.ok, sut.diagnostics.empty());
  expect_file(folder / "expected.err", base::to_text(sut.diagnostics, "glb2idl"));
  std::string idl;
  std::string header;
  std::string layout;
  if (sut.ok) {
    if (GetParam().starts_with("ros2")) {
      const RosPackages packages = emit_ros2(sut.program);
      expect_file(folder / "expected.ros2", base::to_text(packages.problems) + joined(packages.outputs));
    }
    if (GetParam().starts_with("c_")) {
      expect_file(folder / "expected.c.h", joined(emit_c(sut.program)));
    }
    if (GetParam().starts_with("python")) {
      expect_file(folder / "expected.py", emit_python(sut.program));
    }
    ASSERT_FALSE(sut.program.units.empty());
    const std::size_t last = sut.program.units.size() - 1;
    idl = emit_idl(sut.program, sut.program.units[last]);
    header = emit_cpp(sut.program)[last].text;
    layout = emit_layout(sut.program, sut.program.units[last]);
  }
  expect_file(folder / "expected.idl", idl);
  expect_file(folder / "expected.h", header);
  expect_file(folder / "expected.layout", layout);
}

TEST_P(Golden, Schema_in_the_header_can_be_read_back) {
  const Compilation sut = compile({(fs::path(GLB2IDL_GOLDEN) / GetParam() / "in.glb").string()});
  for (const GlbFile& unit : sut.program.units) {
    const schema::Schema written = schema_of(unit);
    const auto read = schema::from_json(schema::to_json(written));
    ASSERT_TRUE(read.ok()) << unit.stem;
    ASSERT_EQ(read.value().variables.size(), written.variables.size());
    ASSERT_EQ(read.value().functions.size(), written.functions.size());
    for (std::size_t i = 0; i < written.variables.size(); ++i) {
      EXPECT_EQ(read.value().variables[i].type_hash, written.variables[i].type_hash) << written.variables[i].name;
      EXPECT_EQ(read.value().variables[i].initial, written.variables[i].initial) << written.variables[i].name;
      EXPECT_EQ(read.value().variables[i].description, written.variables[i].description) << written.variables[i].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, ::testing::ValuesIn(golden::cases(GLB2IDL_GOLDEN, "in.glb")),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::glb2idl
