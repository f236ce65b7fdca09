// SPDX-License-Identifier: Apache-2.0
// Each folder beside this file is a case: in.st, and the C++ and .glb it becomes or the errors in it; in.glb, if there is
// one, holds shared variables it uses. After a wanted change of the output run the test with INDUROP_UPDATE_GOLDEN=1 and
// look at the difference.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "plc/front/compiler.h"

namespace indurop::plc {
namespace {

namespace fs = std::filesystem;

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

void expect_file(const fs::path& path, const std::string& text) {
  if (std::getenv("INDUROP_UPDATE_GOLDEN") != nullptr) {
    if (text.empty()) {
      fs::remove(path);
    } else {
      std::ofstream(path, std::ios::binary) << text;
    }
    return;
  }
  EXPECT_EQ(text.empty(), !fs::exists(path)) << path;
  EXPECT_EQ(slurp(path), text) << path;
}

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
  expect_file(folder / "expected.err", compiled.messages);
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
    EXPECT_TRUE(compiled.ok || !compiled.messages.empty()) << length;
  }
}

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(PLC_GOLDEN)) {
    if (entry.is_directory()) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, ::testing::ValuesIn(cases()), [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::plc
