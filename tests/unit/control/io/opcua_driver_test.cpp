// SPDX-License-Identifier: Apache-2.0
// The driver for OPC UA against a program that answers what the test says (the real one: tests/integration/opcua).
#include "control/io/opcua_driver.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

namespace indurop::io {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

// Listens at a socket. The test plays the program: it takes lines and sends some.
class Program {
 public:
  explicit Program(const std::string& path) : listener_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    std::filesystem::remove(path);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_, 4), 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    hang_up();
    ::close(listener_);
  }

  void hang_up() {
    if (socket_ >= 0) {
      ::close(std::exchange(socket_, -1));
    }
  }
  void accept() {
    hang_up();
    socket_ = ::accept(listener_, nullptr, nullptr);
  }
  std::string line() {
    std::string text;
    for (char c = 0; ::read(socket_, &c, 1) == 1 && c != '\n';) {
      text += c;
    }
    return text;
  }
  void say(const std::string& line) { ASSERT_EQ(::send(socket_, line.data(), line.size(), MSG_NOSIGNAL), line.size()); }

 private:
  int listener_ = -1;
  int socket_ = -1;
};

class OpcuaTest : public ::testing::Test {
 protected:
  OpcuaTest() {
    device_.name = "press";
    device_.driver = config::IoDriver::Opcua;
    device_.address = "opc.tcp://press:4840";
    device_.timeout = milliseconds(2000);
    device_.opcua.socket = path_;
    for (const char* at : {"ns=2;s=a", "ns=2;s=b"}) {
      inputs_.emplace_back().at = at;
      outputs_.emplace_back().at = at;
    }
  }
  ~OpcuaTest() override { std::filesystem::remove(path_); }

  std::unique_ptr<OpcuaDriver> make() { return std::make_unique<OpcuaDriver>(device_, outputs_, inputs_); }

  // A driver with a session.
  std::unique_ptr<OpcuaDriver> opened(Program& program) {
    auto driver = make();
    std::thread peer([&] {
      program.accept();
      description_ = program.line();
      program.say("{\"ready\":true}\n");
    });
    EXPECT_TRUE(driver->open()) << driver->problem();
    peer.join();
    return driver;
  }

  // One exchange that the program answers with this line.
  Driver::Outcome exchange(OpcuaDriver& driver, Program& program, const std::string& answer) {
    std::thread peer([&] {
      request_ = program.line();
      program.say(answer);
    });
    const auto outcome = driver.exchange(to_send_, received_, milliseconds(100));
    peer.join();
    return outcome;
  }

  const std::string path_ = testing::TempDir() + "opcua_driver_" + std::to_string(::getpid()) + ".sock";
  config::IoDevice device_;
  std::vector<config::IoPoint> inputs_;
  std::vector<config::IoPoint> outputs_;
  std::vector<Sample> to_send_{{1, Quality::Good}, {0.1L, Quality::Good}};
  std::vector<Sample> received_{2};
  std::string description_;
  std::string request_;
};

TEST_F(OpcuaTest, Describes_its_device_and_waits_for_a_session) {
  Program program(path_);
  device_.opcua.user = "anna";
  const auto driver = opened(program);
  const auto said = nlohmann::json::parse(description_);
  EXPECT_EQ(said["url"], "opc.tcp://press:4840");
  EXPECT_EQ(said["security"], "encrypt");
  EXPECT_EQ(said["user"], "anna");
  EXPECT_EQ(said["inputs"], nlohmann::json({"ns=2;s=a", "ns=2;s=b"}));
}

TEST_F(OpcuaTest, Waits_on_the_same_connection_for_a_slow_session) {
  Program program(path_);
  device_.timeout = milliseconds(20);
  const auto driver = make();
  EXPECT_FALSE(driver->open());
  EXPECT_THAT(driver->problem(), HasSubstr("waiting for a session with opc.tcp://press:4840"));
  program.accept();
  EXPECT_FALSE(driver->open());
  program.say("{\"ready\":true}\n");
  EXPECT_TRUE(driver->open());
}

TEST_F(OpcuaTest, Says_why_there_is_no_session) {
  const auto alone = make();
  EXPECT_FALSE(alone->open());
  EXPECT_THAT(alone->problem(), HasSubstr("cannot reach indurop-opcua --client at " + path_));
  Program program(path_);
  const auto driver = make();
  std::thread peer([&] {
    program.accept();
    program.say("{\"problem\":\"opc.tcp://press:4840: BadCertificateUntrusted\"}\n");
  });
  EXPECT_FALSE(driver->open());
  peer.join();
  EXPECT_EQ(driver->problem(), "opc.tcp://press:4840: BadCertificateUntrusted");
}

TEST_F(OpcuaTest, Numbers_keep_all_their_digits) {
  Program program(path_);
  const auto driver = opened(program);
  to_send_ = {{18446744073709551615.0L, Quality::Good}, {0.1L, Quality::Good}};
  EXPECT_EQ(exchange(*driver, program,
                     R"({"read":[[1,-9223372036854775807],[1,0.1]],"written":[1,1],"problem":""})"
                     "\n"),
            Driver::Outcome::Good);
  EXPECT_EQ(request_, R"({"write":[[0,"18446744073709551615"],[1,"0.10000000000000001"]]})");
  EXPECT_EQ(received_[0].value, -9223372036854775807.0L);
  EXPECT_EQ(static_cast<double>(received_[1].value), 0.1);
  EXPECT_EQ(received_[0].quality, Quality::Good);
}

TEST_F(OpcuaTest, Only_good_outputs_are_sent) {
  Program program(path_);
  const auto driver = opened(program);
  to_send_ = {{5, Quality::NotRefreshed}, {7, Quality::Good}};
  EXPECT_EQ(exchange(*driver, program,
                     R"({"read":[[1,1],[1,1]],"written":[1,4],"problem":"too large"})"
                     "\n"),
            Driver::Outcome::Partly);
  EXPECT_EQ(request_, R"({"write":[[1,"7"]]})");
  EXPECT_EQ(to_send_[0].quality, Quality::NotRefreshed);
  EXPECT_EQ(to_send_[1].quality, Quality::OutOfRange);
  EXPECT_EQ(driver->problem(), "too large");
}

TEST_F(OpcuaTest, A_bad_value_does_not_change_the_number) {
  Program program(path_);
  const auto driver = opened(program);
  received_[0].value = 3;
  EXPECT_EQ(exchange(*driver, program,
                     R"({"read":[[6,8],[1,null]],"written":[1,1],"problem":"BadSensorFailure"})"
                     "\n"),
            Driver::Outcome::Partly);
  EXPECT_EQ(received_[0].quality, Quality::Reported);
  EXPECT_EQ(received_[0].value, 3);
  EXPECT_TRUE(std::isnan(received_[1].value));  // which the image takes as out of range
}

TEST_F(OpcuaTest, A_program_that_ends_or_hangs_is_lost) {
  Program program(path_);
  device_.timeout = milliseconds(50);
  const auto driver = opened(program);
  EXPECT_EQ(driver->exchange(to_send_, received_, {}), Driver::Outcome::Lost);
  EXPECT_THAT(driver->problem(), HasSubstr("does not answer in time"));
  program.hang_up();
  EXPECT_EQ(driver->exchange(to_send_, received_, {}), Driver::Outcome::Lost);
  EXPECT_THAT(driver->problem(), HasSubstr("has ended"));
}

// An answer with damaged bytes makes no value good that a valid reading of it does not have.
TEST_F(OpcuaTest, Damaged_answers_are_lost_or_valid) {
  Program program(path_);
  auto driver = opened(program);
  std::mt19937 random(7);
  const std::string valid = R"({"read":[[1,17],[3,0]],"written":[1,1],"problem":"x"})";
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = valid;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const auto at = random() % damaged.size();
      const char byte = static_cast<char>(random() % 256);
      damaged[at] = byte == '\n' ? ' ' : byte;
    }
    received_ = std::vector<Sample>(2);
    to_send_ = {{1, Quality::Good}, {1, Quality::Good}};
    const auto outcome = exchange(*driver, program, damaged + "\n");
    const auto read = nlohmann::json::parse(damaged, nullptr, false);
    const bool whole = read.is_object() && read.contains("read") && read["read"].is_array() &&
                       read["read"].size() == 2 && read.contains("written") && read["written"].is_array() &&
                       read["written"].size() == 2;
    ASSERT_EQ(outcome == Driver::Outcome::Lost, !whole) << damaged;
    for (std::size_t i = 0; i < 2 && whole; ++i) {
      const auto& pair = read["read"][i];
      const bool good =
          pair.is_array() && pair.size() == 2 && pair[0] == 1 && (pair[1].is_number() || pair[1].is_null());
      ASSERT_EQ(received_[i].quality == Quality::Good, good) << damaged;
    }
    if (outcome == Driver::Outcome::Lost) {
      driver->close();
      driver = opened(program);
    }
  }
}

}  // namespace
}  // namespace indurop::io
