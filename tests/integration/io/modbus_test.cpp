// SPDX-License-Identifier: Apache-2.0
// Modbus against a second process that behaves and misbehaves: values arrive, bad ones are marked, everything comes
// back on its own, and the tick is never delayed.
#include <csignal>

#include "io_fixture.h"

namespace indurop::test {
namespace {

constexpr std::uint8_t kModbusGood = 1;
constexpr std::uint8_t kModbusLost = 2;
constexpr std::uint8_t kRefused = 3;

class Modbus : public IoTest {
 protected:
  // The points of io_user.
  static std::string device(const std::string& driver, const std::string& address) {
    return "<device name='cell' driver='" + driver + "' address='" + address +
           "' timeout='100ms' retry='20ms' retry_most='100ms' quality='link_good' errors='link_errors'>\n"
           "<input variable='I0' at='discrete:3' quality='I0_quality'/>\n"
           "<input variable='pressure' at='input:10' type='int16' scale='0.1'/>\n"
           "<input variable='speeds[1]' at='holding:20' type='int32' order='cdab'/>\n"
           "<output variable='O0' at='coil:5' stop='1'/>\n"
           "<output variable='speeds[0]' at='holding:30' type='int32'/>\n"
           "<output variable='speeds[2]' at='holding:32'/>\n"
           "</device>";
  }

  void start_with(const std::string& kind) {
    server = &serve(kind, address);
    node_ = &start_and_wait(modules(device("modbus_" + kind, address)));
    ASSERT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusGood));
    EXPECT_TRUE(becomes<bool>("TEST_CELL::link_good", true));
  }

  void exchanges_values() {
    server->input("set discrete 3 1\nset input 10 65500\nset holding 20 34464\nset holding 21 1\n");
    EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
    EXPECT_TRUE(becomes<double>("TEST_CELL::pressure", -36 * 0.1));
    EXPECT_TRUE(has(*server, "holding 30", 1));  // 100000 + 100 = 0x000186A0 + 100
    EXPECT_TRUE(has(*server, "holding 31", 34564));
    EXPECT_TRUE(has(*server, "holding 32", 0)) << "-36 is cut to what fits";
    EXPECT_TRUE(has(*server, "coil 5", 0));
    server->input("set discrete 3 0\n");
    EXPECT_TRUE(has(*server, "coil 5", 1));
  }

  // The device misbehaves: bad quality, held value, good again on its own.
  void survives(const std::string& how, std::uint8_t quality) {
    server->input("set discrete 3 1\nserve\n");
    ASSERT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1)) << how;
    ASSERT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusGood)) << how;
    const auto errors = value<std::uint32_t>("TEST_CELL::link_errors");
    server->input(how + "\n");
    EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", quality)) << how;
    EXPECT_TRUE(becomes<bool>("TEST_CELL::link_good", false)) << how;
    EXPECT_EQ(value<std::int16_t>("TEST_CELL::I0"), 1) << "the last value is held: " << how;
    EXPECT_GT(value<std::uint32_t>("TEST_CELL::link_errors"), errors) << how;
    server->input("set discrete 3 0\nserve\n");
    EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 0)) << how;
    EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusGood)) << how;
  }

  void no_period_was_lost_by_the_module() {
    EXPECT_EQ(module("io").faults.load(), 0U);
    EXPECT_EQ(module("io").overruns.load(), 0U);
  }

  std::string address;
  Program* server = nullptr;
  Program* node_ = nullptr;
};

TEST_F(Modbus, Tcp_exchanges_values_both_ways) {
  start_with("tcp");
  exchanges_values();
}

TEST_F(Modbus, Rtu_exchanges_values_both_ways) {
  start_with("rtu");
  exchanges_values();
}

TEST_F(Modbus, Tcp_survives_what_a_device_may_do) {
  start_with("tcp");
  survives("hang", kModbusLost);
  survives("garbage", kModbusLost);
  survives("trickle", kModbusLost);
  survives("stranger", kModbusLost);
  survives("refuse", kRefused);
  no_period_was_lost_by_the_module();
}

TEST_F(Modbus, Rtu_survives_what_a_device_may_do) {
  start_with("rtu");
  survives("hang", kModbusLost);
  survives("garbage", kModbusLost);
  survives("refuse", kRefused);
  no_period_was_lost_by_the_module();
}

TEST_F(Modbus, A_server_that_leaves_and_returns) {
  start_with("tcp");
  server->input("leave\n");
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusLost));
  server->input("set discrete 3 1\nreturn\n");
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusGood));
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
  EXPECT_TRUE(node_->prints("I/O device cell: good again after "));
}

TEST_F(Modbus, A_server_that_is_killed) {
  start_with("tcp");
  server->kill();
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusLost));
  EXPECT_TRUE(node_->prints("I/O device cell: "));
  no_period_was_lost_by_the_module();
}

TEST_F(Modbus, A_node_starts_without_its_device) {
  server = &serve("tcp", address);
  server->input("leave\n");
  ASSERT_TRUE(server->prints("leave"));
  node_ = &start_and_wait(modules(device("modbus_tcp", address)));
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusLost));
  server->input("set discrete 3 1\nreturn\n");
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
}

TEST_F(Modbus, A_hanging_server_does_not_hold_up_the_end) {
  start_with("tcp");
  server->input("hang\n");
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kModbusLost));
  node_->signal(SIGTERM);
  EXPECT_EQ(node_->wait(), 0);
}

TEST_F(Modbus, What_cannot_be_reached_is_said_with_its_reason) {
  node_ = &start_and_wait(modules(
      "<device name='a' driver='modbus_tcp' address='127.0.0.1:1'><input variable='I0' at='coil:0'/></device>\n"
      "<device name='b' driver='modbus_rtu' address='/dev/no_such_line'><input variable='I1' at='coil:0'/></device>"));
  EXPECT_TRUE(node_->prints("I/O device a: cannot connect to 127.0.0.1 port 1: Connection refused; trying again"));
  EXPECT_TRUE(node_->prints("I/O device b: cannot connect to /dev/no_such_line: No such file or directory; trying"));
}

TEST_F(Modbus, Outputs_get_their_stop_value_at_the_end) {
  start_with("tcp");
  server->input("set discrete 3 1\n");
  ASSERT_TRUE(has(*server, "coil 5", 0));
  node_->signal(SIGTERM);
  EXPECT_EQ(node_->wait(), 0);
  EXPECT_TRUE(has(*server, "coil 5", 1));
}

TEST_F(Modbus, The_module_can_be_stopped_and_started_alone) {
  start_with("tcp");
  server->input("set discrete 3 1\n");
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(has(*server, "coil 5", 0));
    const Outcome stop = indurop({"stop", "io"});
    EXPECT_EQ(stop.code, 0) << stop.out << stop.err;
    EXPECT_TRUE(has(*server, "coil 5", 1)) << "the stop value";
    const Outcome start = indurop({"start", "io"});
    EXPECT_EQ(start.code, 0) << start.out << start.err;
  }
}

TEST_F(Modbus, Outputs_get_their_stop_value_while_the_tick_stands_still) {
  server = &serve("tcp", address);
  std::string xml = device("modbus_tcp", address);
  xml.insert(xml.find("timeout="), "watchdog='50ms' ");
  auto both = modules(xml);
  both[0].period = "500ms";  // for most of the time the outputs are not refreshed
  server->input("set discrete 3 1\n");
  node_ = &start_and_wait(both);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(has(*server, "coil 5", 0)) << "what the program wants";
    EXPECT_TRUE(has(*server, "coil 5", 1)) << "the stop value";
  }
  EXPECT_TRUE(node_->prints("I/O device cell: the tick has stopped"));
}

}  // namespace
}  // namespace indurop::test
