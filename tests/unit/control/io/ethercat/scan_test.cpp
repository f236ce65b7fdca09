// SPDX-License-Identifier: Apache-2.0
// Who is on the bus, as a scan finds it, and that it leaves the slaves as they are.
#include "control/io/ethercat/master/scan.h"

#include <gmock/gmock.h>

#include "real_data.h"
#include "simulated_plant.h"

namespace indurop::io::ethercat {
namespace {

class ScanTest : public testing::Test {
 protected:
  Result<std::vector<FoundSlave>, std::string> scan() {
    return Scan(bus,
                [this] {
                  now += std::chrono::microseconds(20);
                  bus.advance(now);
                  return now;
                })
        .run();
  }
  SimulatedBus bus;
  Clock now{0};
};

TEST_F(ScanTest, Finds_each_slave_with_its_names_and_process_data) {
  bus.segment().add(drive_config(7));
  auto alias = drive_config();
  store<std::uint16_t>(alias.esc.eeprom, 8, 0x1234);
  bus.segment().add(alias);
  const auto sut = scan();
  ASSERT_TRUE(sut) << sut.error();
  ASSERT_EQ(sut->size(), 2U);
  EXPECT_EQ((*sut)[0].problem, "");
  EXPECT_EQ((*sut)[0].sii.identity, (Identity{0x4D8, 0x402, 1, 7}));
  EXPECT_EQ((*sut)[0].sii.name, "Test drive");
  EXPECT_EQ((*sut)[0].sii.outputs.front().entries.at(1).index, 0x607A);
  EXPECT_EQ((*sut)[0].state, AlState::Init);
  EXPECT_EQ((*sut)[0].alias, 0);
  EXPECT_EQ((*sut)[1].alias, 0x1234);
}

TEST_F(ScanTest, Changes_nothing_that_a_running_master_would_see) {
  Plant plant(2);
  plant.run_until_all_operate(2000);
  Clock later = plant.now();
  const auto sut = Scan(plant.bus(), [&] {
                     later += std::chrono::microseconds(20);
                     plant.bus().advance(later);
                     return later;
                   }).run();
  ASSERT_TRUE(sut) << sut.error();
  EXPECT_EQ(sut->size(), 2U);
  EXPECT_EQ((*sut)[1].state, AlState::Op);
  EXPECT_EQ(plant.slave(1).esc().value<std::uint16_t>(reg::kStation), station_of(1));
}

TEST_F(ScanTest, Says_what_is_missing) {
  EXPECT_EQ(scan().error(), "no slave answers; check the cable, and the power of the first slave");
  bus.segment().add(drive_config());
  bus.segment().slave(0).esc().hold_eeprom_busy(std::chrono::hours(1));
  const auto busy = scan();
  ASSERT_TRUE(busy);
  EXPECT_EQ(busy->front().problem, "its EEPROM does not answer");
}

TEST_F(ScanTest, Lost_frames_are_sent_again) {
  bus.segment().add(drive_config());
  for (int i = 0; i < 20; ++i) {
    Fault fault;
    fault.at = std::chrono::milliseconds(3 + 7 * i);
    fault.duration = std::chrono::microseconds(100);
    bus.add_fault(fault);
  }
  const auto sut = scan();
  ASSERT_TRUE(sut) << sut.error();
  EXPECT_EQ(sut->front().sii.name, "Test drive") << sut->front().problem;
}

TEST_F(ScanTest, RealSii_Images_of_real_slaves_come_out_as_they_are) {
  INDUROP_NEEDS_REAL_DATA();
  for (const char* const name :
       {"dumps/ek1100-eeprom-dump.bin", "dumps/el2004-eeprom-dump.bin", "dumps/eeprom/el2262.bin"}) {
    SlaveConfig config;
    config.esc.eeprom = bytes_of_file(real_data() / name);
    const auto whole = read_sii(config.esc.eeprom);
    ASSERT_TRUE(whole) << name;
    SimulatedBus one;
    one.segment().add(config);
    Clock time{0};
    const auto sut = Scan(one, [&] {
                       time += std::chrono::microseconds(20);
                       one.advance(time);
                       return time;
                     }).run();
    ASSERT_TRUE(sut) << name;
    EXPECT_EQ(sut->front().problem, "");
    EXPECT_EQ(sut->front().sii.name, whole->name);
    EXPECT_EQ(sut->front().sii.identity, whole->identity);
    EXPECT_EQ(sut->front().sii.outputs.size(), whole->outputs.size());
    EXPECT_EQ(sut->front().sii.inputs.size(), whole->inputs.size());
    EXPECT_EQ(sut->front().sii.clocks.size(), whole->clocks.size());
  }
}

}  // namespace
}  // namespace indurop::io::ethercat
