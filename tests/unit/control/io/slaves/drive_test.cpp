// SPDX-License-Identifier: Apache-2.0
// The simulated drive as a slave: a master reads its mapping in its EEPROM, enables it and moves it.
#include "control/io/slaves/drive.h"

#include <gmock/gmock.h>

#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/simulator/bus.h"

namespace indurop::io::slaves {
namespace {

using namespace ethercat;

// Where an object of the drive is in its process data, in bytes.
std::size_t offset_of(const std::vector<Pdo>& pdos, std::uint16_t index) {
  std::size_t bits = 0;
  for (const PdoEntry& entry : pdos.front().entries) {
    if (entry.index == index) {
      return bits / 8;
    }
    bits += entry.bits;
  }
  ADD_FAILURE() << "no object " << index;
  return 0;
}

TEST(EcsimDrive, Moves_as_its_master_commands) {
  const auto sii = read_sii(Drive::slave().esc.eeprom);
  ASSERT_TRUE(sii);
  EXPECT_TRUE(sii->checksum_fits);
  Drive drive{config::IoAxis{}};
  SimulatedBus bus;
  Clock now{0};
  drive.attach(bus.segment().add(
      Drive::slave(), [&](Bytes outputs, std::span<std::uint8_t> inputs) { drive.compute(outputs, inputs, now); }));
  Master master(bus, {plan_of(*sii, 0x10000)}, std::chrono::milliseconds(1));
  std::int32_t target = 0;
  bool is_enabled = false;
  for (int i = 0; i < 2000; ++i) {
    now += std::chrono::milliseconds(1);
    bus.advance(now);
    master.cycle(now);
    bus.segment().compute();
    if (!master.is_fresh(0)) {
      continue;
    }
    const auto status = load<std::uint16_t>(master.inputs(0), offset_of(sii->inputs, 0x6041)) & 0x6F;
    const auto position = load<std::int32_t>(master.inputs(0), offset_of(sii->inputs, 0x6064));
    is_enabled = status == 0x27;
    target = is_enabled ? target + 100 : position;
    store<std::uint16_t>(master.outputs(0), offset_of(sii->outputs, 0x6040),
                         status == 0x21                 ? 7
                         : is_enabled || status == 0x23 ? 15
                                                        : 6);
    master.outputs(0)[offset_of(sii->outputs, 0x6060)] = 8;
    store<std::int32_t>(master.outputs(0), offset_of(sii->outputs, 0x607A), target);
    master.set_outputs_good(0, true);
  }
  EXPECT_TRUE(is_enabled);
  EXPECT_GT(target, 100'000);
  EXPECT_NEAR(load<std::int32_t>(master.inputs(0), offset_of(sii->inputs, 0x6064)), target, 2000);
  EXPECT_EQ(load<std::uint16_t>(master.inputs(0), offset_of(sii->inputs, 0x603F)), 0);
}

}  // namespace
}  // namespace indurop::io::slaves
