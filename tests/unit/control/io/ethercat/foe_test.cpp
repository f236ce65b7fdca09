// SPDX-License-Identifier: Apache-2.0
// Files of a slave: random ones there and back, and what is refused. What is on the wire is judged by tshark
// (integration/ethercat).
#include "control/io/ethercat/foe.h"

#include <gmock/gmock.h>

#include <random>

#include "control/io/ethercat/master/foe_client.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

class FoeTest : public testing::Test {
 protected:
  FoeTest() {
    SlaveConfig config = drive_config();
    Sii sii = drive_sii();
    sii.protocols = kProtocolCoe | kProtocolFoe;
    sii.mailbox = {0x1000, 64, 0x1040, 48};
    sii.bootstrap = {0x1000, 48, 0x1040, 64};
    sii.sync_managers[1].length = 48;
    config.esc.eeprom = sii_image(sii);
    bus.segment().add(config);
    slave = Scan(bus, wait()).run()->front();
  }
  Requester::Wait wait() {
    return [this] {
      now += std::chrono::microseconds(20);
      bus.advance(now);
      return now;
    };
  }
  FoeServer& server() { return bus.segment().slave(0).foe(); }
  Result<std::vector<std::uint8_t>, std::string> read(const std::string& name, std::uint32_t password = 0) {
    MailboxSession session(bus, wait(), 0, slave);
    if (std::string wrong = session.open(AlState::PreOp, kProtocolFoe); !wrong.empty()) {
      return wrong;
    }
    return FoeClient(session, password).read(name);
  }
  std::string write(const std::string& name, Bytes content, AlState state = AlState::PreOp) {
    MailboxSession session(bus, wait(), 0, slave);
    std::string wrong = session.open(state, kProtocolFoe);
    return wrong.empty() ? FoeClient(session, 0).write(name, content) : wrong;
  }

  SimulatedBus bus;
  Clock now{0};
  FoundSlave slave;
};

TEST_F(FoeTest, Random_files_come_back_as_they_were_written) {
  std::mt19937 random(9);
  for (int i = 0; i < 60; ++i) {
    // Packets of PREOP have 52 bytes to the slave, 36 from it, those of BOOT 36: with files of just as many, too.
    const std::size_t size = i < 20 ? static_cast<std::size_t>(i) * 12 : random() % 2000;
    std::vector<std::uint8_t> content(size);
    std::generate(content.begin(), content.end(), [&random] { return static_cast<std::uint8_t>(random()); });
    const bool boot = i % 3 == 0;
    const std::string name = boot ? "firmware.efw" : "parameters.txt";
    server().set_busy(static_cast<unsigned>(random() % 3));
    ASSERT_EQ(write(name, content, boot ? AlState::Boot : AlState::PreOp), "") << size;
    EXPECT_EQ(server().files()[name], content);
    const auto sut = read(name);
    ASSERT_TRUE(sut) << sut.error();
    EXPECT_EQ(*sut, content);
    EXPECT_EQ(bus.segment().slave(0).state(), AlState::Init) << "after each of them";
  }
}

TEST_F(FoeTest, What_a_slave_refuses_is_said) {
  EXPECT_EQ(read("nothing.txt").error(), "it refuses: there is no such file (8001h): nothing.txt");
  const std::vector<std::uint8_t> content(100);
  EXPECT_EQ(write("firmware.efw", content), "it refuses: only in the state BOOT (8008h)");
  server().files()["secret.txt"] = content;
  server().set_password(42);
  EXPECT_EQ(read("secret.txt").error(), "it refuses: access is denied (8002h): wrong password");
  EXPECT_TRUE(read("secret.txt", 42));
}

TEST_F(FoeTest, A_slave_without_boot_or_without_files_is_refused) {
  slave.sii.bootstrap = {};
  EXPECT_EQ(write("firmware.efw", {}, AlState::Boot), "it has no mailbox with FoE in BOOT");
  slave.sii.protocols = kProtocolCoe;
  EXPECT_EQ(read("log.txt").error(), "it has no mailbox with FoE");
  slave.sii.protocols = kProtocolFoe;
  bus.segment().set_power(0, false);
  EXPECT_EQ(read("log.txt").error(), "it does not answer any more");
}

TEST(FoeServer, Random_messages_do_no_harm) {
  std::mt19937 random(4);
  FoeServer sut;
  sut.files()["a"] = std::vector<std::uint8_t>(100);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> message(random() % 20);
    std::generate(message.begin(), message.end(), [&random] { return static_cast<std::uint8_t>(random() % 8); });
    EXPECT_LE(sut.answer(message, i % 2 == 0, {30, 30}).size(), 30U + kFoeHeader);
  }
}

}  // namespace
}  // namespace indurop::io::ethercat
