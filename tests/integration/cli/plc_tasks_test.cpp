// SPDX-License-Identifier: Apache-2.0
// Tasks of one PLC program that interrupt each other.
#include "fixture.h"

namespace indurop::test {
namespace {

class PlcTasks : public CommandLine {
 protected:
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  static std::string value(const std::string& name) { return indurop({"get", "--node", "tasks", name}).out; }
};

// The slow task has its image for several scans of the quick one: what it did not change is not its to write.
TEST_F(PlcTasks, Change_elements_of_one_array_without_taking_each_others_back) {
  put(file("tasks.st"),
      "TYPE Pair : STRUCT a, b : DINT; END_STRUCT; END_TYPE\n"
      "VAR_GLOBAL list : ARRAY[1..4] OF DINT; grid : ARRAY[0..1, 0..2] OF INT; pairs : ARRAY[1..2] OF Pair;\n"
      "quick_scans, slow_scans : DINT; END_VAR\n"
      "PROGRAM Quick\n"
      "quick_scans := quick_scans + 1; list[1] := list[1] + 1; grid[0, 1] := grid[0, 1] + 1;\n"
      "pairs[2].a := pairs[2].a + 1;\nEND_PROGRAM\n"
      "PROGRAM Slow VAR i : DINT; x : LREAL; END_VAR\n"
      "FOR i := 1 TO 3000000 DO x := x * 0.99 + 1.0; END_FOR;\n"
      "slow_scans := slow_scans + 1; list[4] := list[4] + 1; grid[0, 2] := grid[0, 2] + 1;\n"
      "pairs[1].b := pairs[1].b + 1;\nEND_PROGRAM\n"
      "CONFIGURATION C RESOURCE R ON PC\n"
      "TASK q (INTERVAL := T#2ms, PRIORITY := 1); TASK s (INTERVAL := T#100ms, PRIORITY := 2);\n"
      "PROGRAM pq WITH q : Quick; PROGRAM ps WITH s : Slow;\nEND_RESOURCE END_CONFIGURATION\n");
  const Outcome built = indurop({"plc", "build", file("tasks.st"), "-o", file("tasks")});
  ASSERT_EQ(built.code, 0) << built.err;
  put(file("tasks/module.xml"), "<root>\n" + built.out + "</root>\n");
  const Outcome ran = indurop({"run", file("tasks/module.xml"), "-q", "--node", "tasks", "--duration", "2s"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string quick = std::to_string(std::stoi(value("quick_scans")));
  const std::string slow = std::to_string(std::stoi(value("slow_scans")));
  EXPECT_NE(quick, "0");
  EXPECT_NE(slow, "0");
  EXPECT_THAT(value("list"), testing::HasSubstr("[" + quick + ", 0, 0, " + slow + "]"));
  EXPECT_THAT(value("grid"), testing::HasSubstr("[[0, " + quick + ", " + slow + "], [0, 0, 0]]"));
  EXPECT_THAT(value("pairs"), testing::HasSubstr("[{a: 0, b: " + slow + "}, {a: " + quick + ", b: 0}]"));
}

}  // namespace
}  // namespace indurop::test
