// SPDX-License-Identifier: Apache-2.0
// A node whose I/O module is the master of simulated drives at a veth pair.

#pragma once

#include <memory>
#include <string>

#include "node_fixture.h"
#include "veth_fixture.h"

namespace indurop::test {

inline constexpr std::uint16_t kOperationEnabled = 0x27;
inline constexpr std::uint16_t kStateBits = 0x6F;

class EthercatNode : public NodeTest {
 protected:
  void SetUp() override {
    if (!io::ethercat::make_cable()) {
      GTEST_SKIP() << "no right to a network with a veth pair of its own";
    }
    NodeTest::SetUp();
  }
  void simulate(std::size_t drives) {
    drives_ = io::ethercat::start_drives(drives, (folder() / "frames.pcap").string());
  }

  Program& start_node(const std::string& devices) {
    write("ioconfig.xml", "<ioconfig>\n" + devices + "\n</ioconfig>\n");
    return start(modules());
  }
  Program& run_node(const std::string& devices) {
    Program& node = start_node(devices);
    EXPECT_TRUE(wait_until_running(node)) << node.err();
    return node;
  }
  static std::vector<Module> modules() {
    return {
        {.file = IO_MODULE, .name = "io", .period = "2ms", .priority = 1, .properties = {{"config", "ioconfig.xml"}}},
        {.file = std::string(IO_FOLDER) + "/axis_user.so", .name = "axis_user", .period = "2ms", .priority = 2}};
  }
  Program& run_node_with_two_drives() {
    return run_node(
        "<device name='axis1' driver='ethercat' address='ec0' slave='0' product='0x49525001' revision='0x1'\n"
        "  in='TEST_CELL::AXIS1_IN' out='TEST_CELL::AXIS1_OUT' quality='TEST_CELL::link_good'\n"
        "  errors='TEST_CELL::link_errors'/>\n"
        "<device name='axis2' driver='ethercat' address='ec0' slave='1' quality='TEST_CELL::I0_quality'>\n"
        "  <input variable='speeds[1]' at='6041'/>\n"
        "  <output variable='speeds[2]' at='607a:0'/>\n"
        "</device>");
  }
  long number(const std::string& name) const { return std::stol(indurop({"get", "TEST_CELL::" + name}).out); }
  bool moves() {
    const long from = number("AXIS1_IN.position");
    return wait_until([&] {
      return (number("AXIS1_IN.status") & kStateBits) == kOperationEnabled && number("AXIS1_IN.position") > from + 5000;
    });
  }

  std::unique_ptr<Program> drives_;
};

}  // namespace indurop::test
