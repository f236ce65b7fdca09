// SPDX-License-Identifier: Apache-2.0
// Our Modbus against another implementation of the protocol on the other side: pymodbus.
#include "io_fixture.h"

namespace indurop::test {
namespace {

constexpr std::uint8_t kGood = 1;
constexpr std::uint8_t kLost = 2;
constexpr const char* kPort = "1502";
constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has pymodbus; another may come first in PATH

class ModbusJudge : public IoTest {
 protected:
  static bool has_pymodbus() { return Program({kPython, "-c", "import pymodbus"}).wait() == 0; }

  void SetUp() override {
    if (!has_pymodbus()) {
      GTEST_SKIP() << "python3-pymodbus is not installed";
    }
    IoTest::SetUp();
  }

  Program& judge(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {kPython, MODBUS_JUDGE});
    judges_.push_back(std::make_unique<Program>(arguments));
    EXPECT_TRUE(judges_.back()->prints("ready\n")) << judges_.back()->err();
    return *judges_.back();
  }
  Program& client() { return judge({"client", address_, kPort}); }

  // What it answers, without the end of the line.
  static std::string ask(Program& judge, const std::string& command) {
    const std::size_t from = judge.out().size();
    judge.input(command + "\n");
    EXPECT_TRUE(wait_until([&] { return judge.out().find('\n', from) != std::string::npos; }))
        << command << judge.err();
    const std::string out = judge.out();
    return out.substr(from, out.find('\n', from) - from);
  }
  static bool sees(Program& judge, const std::string& command, const std::string& wanted) {
    std::string last;
    const bool did = wait_until([&] { return (last = ask(judge, command)) == wanted; });
    EXPECT_TRUE(did) << command << ": " << last << ", not " << wanted;
    return did;
  }

  Program& panel() {
    return start_and_wait(modules("<device name='panel' driver='modbus_server' address='" + address_ + ":" + kPort +
                                  "' cycle='1ms' timeout='1min' quality='link_good'>\n"
                                  "<input variable='I0' at='coil:5' quality='I0_quality' bad='zero'/>\n"
                                  "<input variable='pressure' at='holding:10' type='float32' order='cdab'/>\n"
                                  "<input variable='speeds[1]' at='holding:20' type='int32'/>\n"
                                  "<input variable='running' at='holding:30.4'/>\n"
                                  "<output variable='O0' at='discrete:3'/>\n"
                                  "<output variable='speeds[0]' at='input:7' type='int32' stop='-1'/>\n"
                                  "<output variable='speeds[2]' at='holding:40'/>\n"
                                  "</device>"));
  }

  static std::string own_address() {
    static int tests = 0;
    const int pid = ::getpid();
    return "127." + std::to_string(100 + ++tests) + "." + std::to_string(pid / 256 % 256) + "." +
           std::to_string(pid % 256);
  }

  // On the loopback, of this test alone, so that the port is free.
  const std::string address_ = own_address();
  std::vector<std::unique_ptr<Program>> judges_;
};

TEST_F(ModbusJudge, A_panel_reads_and_writes_our_variables) {
  panel();
  Program& sut = client();
  EXPECT_TRUE(sees(sut, "read discrete 3 1", "ok 1"));
  EXPECT_EQ(ask(sut, "write coil 5 1"), "ok ");
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kGood));
  EXPECT_TRUE(sees(sut, "read discrete 3 1", "ok 0"));
  EXPECT_EQ(ask(sut, "write holding 10 0 16320"), "ok ");  // 1.5, low word first
  EXPECT_TRUE(becomes<double>("TEST_CELL::pressure", 1.5));
  EXPECT_TRUE(sees(sut, "read holding 40 1", "ok 15"));
  EXPECT_EQ(ask(sut, "both 40 1 20 1 34464"), "ok 15");  // 100 000
  EXPECT_TRUE(sees(sut, "read input 7 2", "ok 1 34564"));
  EXPECT_EQ(ask(sut, "mask 30 ffef 0010"), "ok ");
  EXPECT_TRUE(becomes<bool>("TEST_CELL::running", true));
  EXPECT_EQ(ask(sut, "read holding 30 1"), "ok 16");
}

TEST_F(ModbusJudge, What_a_panel_may_not_do_is_refused_and_changes_nothing) {
  panel();
  Program& sut = client();
  ASSERT_TRUE(sees(sut, "read discrete 3 1", "ok 1"));
  EXPECT_EQ(ask(sut, "write holding 40 7"), "exception 2") << "an output";
  EXPECT_EQ(ask(sut, "write holding 20 7"), "exception 2") << "half of a number";
  EXPECT_EQ(ask(sut, "read input 6 2"), "exception 2");
  EXPECT_EQ(ask(sut, "write coil 4 1"), "exception 2");
  EXPECT_EQ(ask(sut, "raw 000100000006090300140001"), "answer 00010000000309830b") << "another unit";
  EXPECT_EQ(ask(sut, "raw 000100000005010300140001"), "answer 000100000003018303") << "a request that ends too early";
  EXPECT_EQ(ask(sut, "raw 0001000100060103001400011234"), "answer ") << "no Modbus: the connection ends";
  EXPECT_EQ(ask(sut, "raw 00010000ffff0103"), "answer ");
  EXPECT_EQ(ask(sut, "read holding 40 1"), "ok 0");
  EXPECT_EQ(value<std::int32_t>("TEST_CELL::speeds"), 100);
}

TEST_F(ModbusJudge, What_a_panel_wrote_is_bad_once_it_has_left) {
  Program& node = panel();
  Program& other = client();
  Program& sut = client();
  EXPECT_EQ(ask(sut, "write coil 5 1"), "ok ");
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
  EXPECT_EQ(ask(sut, "leave"), "left");
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kLost)) << "although another client is there";
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 0)) << "what bad says";
  EXPECT_TRUE(becomes<bool>("TEST_CELL::link_good", false));
  EXPECT_TRUE(node.prints("I/O device panel: the client that wrote I0 has left"));
  EXPECT_EQ(ask(other, "write coil 5 1"), "ok ");
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kGood));
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
}

TEST_F(ModbusJudge, Many_clients_and_one_that_never_ends_its_request) {
  panel();
  Program& sut = client();
  ASSERT_TRUE(sees(sut, "read discrete 3 1", "ok 1"));
  Program crowd({kPython, "-c",
                 "import socket, sys\n"
                 "kept = [socket.create_connection(('" +
                     address_ +
                     "', 1502)) for _ in range(100)]\n"
                     "[one.send(b'\\0\\1\\0') for one in kept[-20:]]\n"
                     "print('there', flush=True)\n"
                     "sys.stdin.read()\n"});
  ASSERT_TRUE(crowd.prints("there"));
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(ask(sut, "read discrete 3 1"), "ok 1");
  }
  EXPECT_EQ(module("io").faults.load(), 0U);
  EXPECT_EQ(module("io").overruns.load(), 0U);
}

class ModbusDevice : public ModbusJudge, public testing::WithParamInterface<const char*> {};

TEST_P(ModbusDevice, Is_read_and_written_in_all_ways) {
  const std::string framing = GetParam();
  Program& device = judge({"server", framing, address_, kPort});
  start_and_wait(modules("<device name='cell' driver='modbus_tcp' framing='" + framing + "' address='" + address_ +
                         ":" + kPort +
                         "' together='on' cycle='5ms' timeout='1s' errors='link_errors'>\n"
                         "<input variable='pressure' at='holding:10' quality='I0_quality'/>\n"
                         "<input variable='I0' at='holding:50' cycle='20ms'/>\n"
                         "<output variable='O0' at='holding:20.4'/>\n"
                         "<output variable='speeds[2]' at='holding:30' type='int32'/>\n"
                         "</device>"));
  EXPECT_EQ(ask(device, "set holding 20 43690"), "holding 20 = 43690");
  EXPECT_EQ(ask(device, "set holding 10 77"), "holding 10 = 77");
  EXPECT_TRUE(becomes<double>("TEST_CELL::pressure", 77));
  EXPECT_TRUE(becomes<std::uint8_t>("TEST_CELL::I0_quality", kGood));
  EXPECT_TRUE(sees(device, "get holding 31", "holding 31 = 770"));
  EXPECT_TRUE(sees(device, "get holding 20", "holding 20 = 43706")) << "only its bit";
  EXPECT_EQ(ask(device, "set holding 50 1"), "holding 50 = 1");
  EXPECT_TRUE(becomes<std::int16_t>("TEST_CELL::I0", 1));
  EXPECT_TRUE(sees(device, "get holding 20", "holding 20 = 43690"));
  EXPECT_EQ(value<std::uint32_t>("TEST_CELL::link_errors"), 0U);
}

INSTANTIATE_TEST_SUITE_P(Framings, ModbusDevice, testing::Values("tcp", "rtu"),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace indurop::test
