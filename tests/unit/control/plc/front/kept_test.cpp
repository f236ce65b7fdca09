// SPDX-License-Identifier: Apache-2.0
// How a program describes what it keeps from scan to scan, so that another version of it can continue with that.

#include <gmock/gmock.h>

#include "tests/unit/control/plc/front/compiled.h"

namespace indurop::plc {
namespace {

using testing::compiled;
using ::testing::HasSubstr;
using testing::messages;

// The type in the line of a kept variable.
std::string type_of(const std::string& variable, const std::string& text) {
  const Compiled sut = compiled(text);
  EXPECT_TRUE(sut.ok) << messages(sut);
  const std::string& cpp = sut.modules.front().cpp;
  const std::string line = "iec::kept(\"Main." + variable + "\", \"";
  const std::size_t begin = cpp.find(line);
  EXPECT_NE(begin, std::string::npos) << variable;
  return begin == std::string::npos
             ? ""
             : cpp.substr(begin + line.size(), cpp.find('"', begin + line.size()) - begin - line.size());
}

std::string type_of_array(const std::string& bounds, const std::string& fields) {
  return type_of("a", "TYPE Point : STRUCT " + fields +
                          " END_STRUCT; END_TYPE\n"
                          "PROGRAM Main VAR a : ARRAY[" +
                          bounds + "] OF Point; END_VAR a[1].x := 1; END_PROGRAM");
}

TEST(PlcKept, Arrays_say_their_bounds_and_their_elements_what_they_contain) {
  EXPECT_EQ(type_of("a", "PROGRAM Main VAR a : ARRAY[1..4] OF INT; END_VAR a[1] := 1; END_PROGRAM"),
            "ARRAY[1..4] OF INT");
  const std::string four = type_of_array("1..4", "x : INT; y : REAL;");
  const std::string six = type_of_array("1..6", "x : INT; y : REAL;");
  const std::string beginning = "ARRAY[1..4] OF Point #";
  EXPECT_THAT(four, ::testing::StartsWith(beginning));
  EXPECT_EQ(six, "ARRAY[1..6] OF Point #" + four.substr(beginning.size()));
  EXPECT_NE(four, type_of_array("1..4", "x : INT; y : LREAL;"));
}

TEST(PlcKept, The_power_flow_is_only_shown) {
  CompileOptions options;
  options.files = {PLC_TESTS "/golden/plcopen/openplc_ladder/in.xml"};
  options.name = "sut";
  options.watch = true;
  const Compiled sut = compile(options, &glb2idl::read_source_file);
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_THAT(sut.modules.front().cpp, HasSubstr("._flow\", \"shown: ARRAY[0.."));
}

}  // namespace
}  // namespace indurop::plc
