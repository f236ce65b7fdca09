// SPDX-License-Identifier: Apache-2.0
// Types that .glb files declare, in a program.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using ::testing::HasSubstr;
using testing::messages;

// press.Mode#PRESSING and its other forms, of an enumeration in a .glb file.
TEST(PlcGlbTypes, Values_of_an_enumeration_of_a_glb_file_are_named_in_each_way) {
  const auto said = [](const std::string& statement) {
    CompileOptions options;
    options.files = {"in.st"};
    options.glb_files = {"press.glb"};
    options.name = "sut";
    const Compiled made = compile(options, [&](const std::string& name) {
      const std::string text = name == "press.glb" ? "namespace press;\nenum Mode { IDLE, PRESSING };\nMode mode;\n"
                                                     "struct State { Mode now; int32_t n; };\nState state;\n"
                                                   : "PROGRAM Main VAR b : BOOL; m : press.Mode; k : Mode; END_VAR " +
                                                         statement + " m := k; END_PROGRAM";
      return glb2idl::ReadResult{text, name, ""};
    });
    return made.ok ? made.modules.at(0).cpp : messages(made);
  };
  for (const char* value :
       {"press.Mode#PRESSING", "press.Mode.PRESSING", "Mode#PRESSING", "Mode.PRESSING", "press.PRESSING", "PRESSING"}) {
    EXPECT_THAT(said(std::string("m := ") + value + ";"), HasSubstr("m = ::press::Mode::PRESSING;")) << value;
    EXPECT_THAT(said(std::string("b := press.mode = ") + value + ";"), HasSubstr("::press::Mode::PRESSING")) << value;
    EXPECT_THAT(said(std::string("press.state.now := ") + value + ";"), HasSubstr("= ::press::Mode::PRESSING;"))
        << value;
    EXPECT_THAT(said(std::string("CASE press.mode OF ") + value + ": b := TRUE; END_CASE;"),
                HasSubstr("case_1 == ::press::Mode::PRESSING"))
        << value;
  }
  EXPECT_THAT(said("m := press.Mode#PRESING;"), HasSubstr("did you mean 'PRESSING'?"));
}

}  // namespace
}  // namespace indurop::plc
