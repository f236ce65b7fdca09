// SPDX-License-Identifier: Apache-2.0
// Tasks as the editors write them: which modules a file becomes, and how often they run.

#include <gtest/gtest.h>

#include <chrono>

#include "control/plc/front/compiler.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use

plc::Compiled compiled(const std::vector<std::string>& cases) {
  plc::CompileOptions options;
  for (const std::string& one : cases) {
    options.files.push_back(std::string(PLCOPEN_CASES) + "/" + one + "/in.xml");
  }
  options.name = "sut";
  return plc::compile(options);
}

std::string messages(const plc::Compiled& program) {
  return base::to_text(program.diagnostics);
}

std::chrono::nanoseconds period_of(const plc::Compiled& program) {
  return std::chrono::nanoseconds(program.modules.at(0).period_ns);
}

TEST(PlcTasks, An_interval_may_stand_in_an_extension) {
  const plc::Compiled twincat = compiled({"twincat_application"});
  ASSERT_TRUE(twincat.ok) << messages(twincat);
  EXPECT_EQ(period_of(twincat), 5ms);
  EXPECT_EQ(twincat.modules.at(0).priority, 20);
  const plc::Compiled codesys = compiled({"codesys_project"});
  ASSERT_TRUE(codesys.ok) << messages(codesys);
  EXPECT_EQ(period_of(codesys), 20ms);
}

TEST(PlcTasks, An_interval_may_be_a_clock_time) {
  const plc::Compiled sut = compiled({"beremiz_details"});
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_EQ(period_of(sut), 20ms);
}

TEST(PlcTasks, Programs_of_libraries_are_left_out_with_a_warning) {
  const plc::Compiled sut = compiled({"codesys_project"});
  EXPECT_EQ(sut.modules.size(), 1U);
  EXPECT_NE(messages(sut).find("warning: program VisuElems.Visu_Prg: this is a program of a library"),
            std::string::npos)
      << messages(sut);
}

TEST(PlcTasks, Types_may_come_from_a_file_of_their_own) {
  const plc::Compiled alone = compiled({"types_only"});
  EXPECT_NE(messages(alone).find("there is no PROGRAM that could run"), std::string::npos) << messages(alone);
  const plc::Compiled both = compiled({"beremiz_details", "types_only"});
  EXPECT_TRUE(both.ok) << messages(both);
}

TEST(PlcTasks, Two_files_with_charts_are_one_program) {
  const plc::Compiled sut = compiled({"beremiz_chart", "twincat_application"});
  EXPECT_EQ(messages(sut).find("SFC_STEP"), std::string::npos) << messages(sut);
}

}  // namespace
}  // namespace indurop
