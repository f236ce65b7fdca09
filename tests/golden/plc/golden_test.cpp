// SPDX-License-Identifier: Apache-2.0
// Each folder beside this file is a case: in.st, and the C++ and .glb it becomes or the errors in it; in.glb, if there
// is one, holds shared variables it uses. After a wanted change of the output run the test with INDUROP_UPDATE_GOLDEN=1
// and look at the difference.

#include <gtest/gtest.h>

#include <filesystem>

#include "control/plc/front/compiler.h"
#include "tests/golden/golden.h"

namespace indurop::plc {
namespace {

namespace fs = std::filesystem;
using golden::expect_file;
using golden::slurp;

// Compiles in.st as `program`, with the names as if the folder were the current one.
Compiled compile_case(const fs::path& folder, const std::string& program) {
  CompileOptions options;
  options.files = {"in.st"};
  options.name = "golden";
  if (fs::exists(folder / "in.glb")) {
    options.glb_files = {"in.glb"};
  }
  return compile(options, [&](const std::string& name) {
    return glb2idl::ReadResult{name == "in.st" ? program : slurp(folder / name), name, ""};
  });
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, Output_or_errors_are_as_expected) {
  const fs::path folder = fs::path(PLC_GOLDEN) / GetParam();
  const Compiled compiled = compile_case(folder, slurp(folder / "in.st"));
  std::string cpp;
  for (const ModuleText& one : compiled.modules) {
    cpp += one.cpp;
  }
  expect_file(folder / "expected.err", base::to_text(compiled.diagnostics, "indurop plc"));
  expect_file(folder / "expected.cpp", compiled.ok ? cpp : "");
  expect_file(folder / "expected.glb", compiled.ok ? compiled.glb : "");
  expect_file(folder / "expected.xml", compiled.ok ? module_xml(compiled.modules) : "");
}

TEST_P(Golden, A_program_cut_off_anywhere_does_no_harm) {
  const fs::path folder = fs::path(PLC_GOLDEN) / GetParam();
  const std::string whole = slurp(folder / "in.st");
  constexpr std::size_t kStep = 23;
  for (std::size_t length = 0; length < whole.size(); length += kStep) {
    const Compiled compiled = compile_case(folder, whole.substr(0, length));
    EXPECT_TRUE(compiled.ok || !compiled.diagnostics.empty()) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, ::testing::ValuesIn(golden::cases(PLC_GOLDEN, "in.st")),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::plc
