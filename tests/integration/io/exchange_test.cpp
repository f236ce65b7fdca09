// SPDX-License-Identifier: Apache-2.0
// The dispatcher and its exchange threads without a node, against a Modbus server of its own process: the part where
// threads meet, small enough for the sanitizers to watch.
#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <filesystem>
#include <fstream>

#include <indurop/generated.h>

#include "control/io/dispatcher.h"
#include "core/schema/elf.h"
#include "tests/support/program.h"

namespace indurop::io {
namespace {

using std::chrono::milliseconds;

class Exchange : public ::testing::Test {
 protected:
  Exchange() : server_({std::string(IO_FOLDER) + "/modbus_server", "tcp"}) {
    EXPECT_TRUE(test::wait_until([&] { return server_.out().find('\n') != std::string::npos; }));
    address_ = server_.out().substr(3, server_.out().find('\n') - 3);
    auto schema = schema::from_json(schema::read_module_file("/proc/self/exe").value().schema_json);
    schema_ = std::move(schema).value();
    file_ = std::filesystem::temp_directory_path() / ("indurop-exchange-" + std::to_string(server_.pid()) + ".xml");
    TEST_CELL::I0 = 0;
    TEST_CELL::I0_quality = 0;
  }
  ~Exchange() override { std::filesystem::remove(file_); }

  std::unique_ptr<Dispatcher> started() {
    std::ofstream(file_) << "<ioconfig><device name='a' driver='modbus_tcp' address='" << address_
                         << "' cycle='1ms' timeout='50ms' retry='1ms' retry_most='10ms' errors='link_errors'>"
                            "<input variable='I0' at='holding:1' quality='I0_quality'/>"
                            "<output variable='O0' at='holding:2' stop='77'/></device></ioconfig>";
    auto [sut, diagnostics] = Dispatcher::make(file_, schema_, Phase::Both);
    EXPECT_TRUE(diagnostics.empty() && sut != nullptr && sut->start(0));
    return std::move(sut);
  }
  // Ticks until it holds.
  template <class Condition>
  static bool runs_until(Dispatcher& sut, Condition condition) {
    return test::wait_until([&] {
      sut.run(milliseconds(1));
      return condition();
    });
  }

  test::Program server_;
  std::string address_;
  std::filesystem::path file_;
  schema::Schema schema_;
};

TEST_F(Exchange, Values_go_round_while_the_tick_goes_on) {
  const auto sut = started();
  for (std::int16_t n = 1; n < 20; ++n) {
    server_.input("set holding 1 " + std::to_string(n) + "\n");
    ASSERT_TRUE(runs_until(*sut, [n] { return TEST_CELL::I0 == n; })) << n;
  }
}

TEST_F(Exchange, Everything_comes_back) {
  const auto sut = started();
  for (const char* how : {"hang", "garbage", "stranger", "leave"}) {
    server_.input("serve\n");
    ASSERT_TRUE(runs_until(*sut, [] { return TEST_CELL::I0_quality == 1; })) << how;
    server_.input(std::string(how) + "\n");
    EXPECT_TRUE(runs_until(*sut, [] { return TEST_CELL::I0_quality == 2; })) << how;
  }
  server_.input("serve\nreturn\n");
  EXPECT_TRUE(runs_until(*sut, [] { return TEST_CELL::I0_quality == 1; }));
}

TEST_F(Exchange, Starts_and_stops_at_any_moment) {
  for (int i = 0; i < 20; ++i) {
    const auto sut = started();
    for (int k = 0; k < i; ++k) {
      sut->run(milliseconds(1));
    }
    sut->stop();
    sut->stop();
  }
  EXPECT_TRUE(server_.running());
}

}  // namespace
}  // namespace indurop::io
