// SPDX-License-Identifier: Apache-2.0
// The I/O module in a node: figures of the chapter, checks before the start, two modules with one file.
#include <csignal>

#include "io_fixture.h"

namespace indurop::test {
namespace {

using IoNode = IoTest;

TEST_F(IoNode, A_drive_moves_as_the_program_wants) {
  Program& sut = start_and_wait(
      modules("<device name='axis' driver='cia402' in='TEST_CELL::AXIS1_IN' out='TEST_CELL::AXIS1_OUT' start='10'/>",
              "axis_user"));
  ASSERT_TRUE(runs_reach("io", 300));
  const Outcome position = indurop({"get", "TEST_CELL::AXIS1_IN.position"});
  EXPECT_EQ(position.code, 0) << position.err;
  EXPECT_GT(std::stol(position.out), 36'667 + 100 * 200) << "from 10 degrees on, 100 counts per period";
  EXPECT_EQ(indurop({"get", "TEST_CELL::AXIS1_IN.error"}).out, "0\n");
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(IoNode, Recorded_values_come_in_by_time) {
  write("values.csv", "time_ms,I0,p\n0,1,2.5\n50,2,3.5\n");
  start_and_wait(
      modules("<device name='rec' driver='csv' file='values.csv'><input variable='I0'/>"
              "<input variable='pressure' at='p'/></device>"));
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 2));
  EXPECT_TRUE(becomes<double>("TEST_CELL::pressure", 3.5));
}

TEST_F(IoNode, Check_knows_what_the_file_reads_and_writes) {
  const std::string xml_file =
      write("module.xml", xml(modules("<device name='a' driver='modbus_tcp' address='127.0.0.1:1' quality='link_good'>"
                                      "<input variable='I0' at='coil:0'/><input variable='pressure' at='input:0'/>"
                                      "<input variable='speeds[1]' at='input:1'/><output variable='O0' at='coil:1'/>"
                                      "<output variable='speeds[0]' at='holding:0'/></device>")));
  const Outcome sut = indurop({"check", xml_file});
  EXPECT_EQ(sut.code, 0) << sut.out << sut.err;
  EXPECT_EQ(sut.out.find("no module writes"), std::string::npos) << sut.out;
  EXPECT_CONTAINS(sut.out, "TEST_CELL::I0 ");
  EXPECT_CONTAINS(sut.out, "TEST_CELL::link_good");
}

TEST_F(IoNode, Check_and_node_say_what_is_wrong_with_the_file) {
  const auto wrong = modules(
      "<device name='a' driver='modbus_tcp' address='127.0.0.1'>\n"
      "<input variable='I17' at='coil:0'/>\n<input variable='I0' at='coil'/></device>");
  const std::string xml_file = write("module.xml", xml(wrong));
  const Outcome check = indurop({"check", xml_file});
  EXPECT_EQ(check.code, 4) << check.out;
  EXPECT_CONTAINS(check.out + check.err, "ioconfig.xml:3:18: error: no variable 'I17'; did you mean");
  EXPECT_CONTAINS(check.out + check.err, "ioconfig.xml:4:26: error: at: 'coil' is not an address of a Modbus device");
  const Outcome node = run_to_end(wrong);
  EXPECT_EQ(node.code, 4);
  EXPECT_CONTAINS(node.err, "ioconfig.xml:3:18: error: no variable 'I17'");
}

TEST_F(IoNode, A_module_without_a_file_and_one_whose_values_are_missing_do_not_start) {
  auto without = modules("");
  without[0].properties.clear();
  const Outcome no_file = run_to_end(without);
  EXPECT_EQ(no_file.code, 4);
  EXPECT_CONTAINS(no_file.err, "module io needs an ioconfig.xml; add <property>");
  const auto gone = modules("<device name='rec' driver='csv' file='gone.csv'><input variable='I0'/></device>");
  const Outcome no_values = run_to_end(gone);
  EXPECT_EQ(no_values.code, 4);
  EXPECT_CONTAINS(no_values.out + no_values.err, "gone.csv: error: cannot be read: No such file");
  const Outcome check = indurop({"check", write("module.xml", xml(gone))});
  EXPECT_EQ(check.code, 4);
  EXPECT_CONTAINS(check.out + check.err, "gone.csv: error: cannot be read: No such file");
}

TEST_F(IoNode, Check_reads_recorded_values) {
  write("run.csv", "time,I0\n0,1\n1,one\n");
  const auto wrong = modules("<device name='rec' driver='csv' file='run.csv'><input variable='I0'/></device>");
  const Outcome bad_cell = indurop({"check", write("module.xml", xml(wrong))});
  EXPECT_EQ(bad_cell.code, 4);
  EXPECT_CONTAINS(bad_cell.out + bad_cell.err, "run.csv:3:3: error: 'one' is not a number");
  write("run.csv", "time,I1\n0,1\n");
  const Outcome no_column = indurop({"check", write("module.xml", xml(wrong))});
  EXPECT_CONTAINS(no_column.out + no_column.err, "run.csv:1:1: error: there is no column 'I0'; there are I1");
}

TEST_F(IoNode, Two_modules_split_inputs_and_outputs) {
  std::string address;
  Program& server = serve("tcp", address);
  auto three = modules("<device name='a' driver='modbus_tcp' address='" + address +
                       "'><input variable='I0' at='discrete:3'/><output variable='O0' at='coil:5'/></device>");
  three[0].properties.emplace_back("phase", "inputs");
  Module outputs = three[0];
  outputs.name = "out";
  outputs.priority = 3;
  outputs.properties.back().second = "outputs";
  three.push_back(outputs);
  start_and_wait(three);
  EXPECT_TRUE(has(server, "coil 5", 1));
  server.input("set discrete 3 1\n");
  EXPECT_TRUE(has(server, "coil 5", 0));
}

}  // namespace
}  // namespace indurop::test
