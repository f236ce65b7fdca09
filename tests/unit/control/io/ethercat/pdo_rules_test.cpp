// SPDX-License-Identifier: Apache-2.0
// What a simulated slave lets its master write to its mapping: the order of the standard (ETG.1000.6), and its codes.
#include "control/io/ethercat/simulator/pdo_rules.h"

#include <gtest/gtest.h>

#include <memory>

#include "fillable.h"

namespace indurop::io::ethercat {
namespace {

class MappingRules : public testing::Test {
 protected:
  MappingRules() : device_({{0x3000, 0, 16, 6}}, {{0x4000, 0, 32, 7}}) {
    device_.sii.outputs.push_back({0x1602, kNotAssigned, kPdoFixed, "", {{0x6040, 0, 16, 6, ""}}});
    device_.config.esc.eeprom = sii_image(device_.sii);
    slave_ = std::make_unique<Slave>(device_.config);
    slave_->esc().set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(AlState::PreOp));
  }
  // The abort code; 0: it was written.
  template <class T>
  std::uint32_t write(std::uint16_t index, std::uint8_t subindex, T number) {
    std::vector<std::uint8_t> bytes(sizeof(T));
    store<T>(bytes, 0, number);
    return slave_->objects().write(index, subindex, false, bytes).value_or(0);
  }

  Fillable device_;
  std::unique_ptr<Slave> slave_;
};

TEST_F(MappingRules, The_order_of_writes_is_the_standards) {
  EXPECT_EQ(write<std::uint16_t>(0x1C12, 1, 0x1601), 0x06010003U) << "its count is not 0";
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 0), 0U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000010), 0x06010003U);
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 0), 0U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000010), 0U);
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 1), 0U);
  EXPECT_EQ(write<std::uint16_t>(0x1C12, 1, 0x1600), 0U);
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 1), 0U);
}

TEST_F(MappingRules, Contents_change_while_the_pdo_is_assigned) {
  ASSERT_EQ(slave_->objects().number(0x1C12, 1), 0x1600U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000010), 0x06010003U) << "its count is not 0";
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 0), 0U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000010), 0U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 2, 0x00000008), 0U) << "a gap";
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 2), 0U);
}

TEST_F(MappingRules, An_assigned_pdo_does_not_outgrow_its_sync_manager) {
  device_.sii.sync_managers[3].start = kDriveOutputs + 5;
  device_.config.esc.eeprom = sii_image(device_.sii);
  slave_ = std::make_unique<Slave>(device_.config);
  slave_->esc().set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(AlState::PreOp));
  ASSERT_EQ(write<std::uint8_t>(0x1600, 0, 0), 0U);
  for (std::uint8_t i = 1; i <= 3; ++i) {
    ASSERT_EQ(write<std::uint32_t>(0x1600, i, 0x30000010), 0U);
  }
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 3), 0x06040042U) << "six bytes";
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 2), 0U);
}

TEST_F(MappingRules, What_is_wrong_is_aborted_with_the_standards_code) {
  ASSERT_EQ(write<std::uint8_t>(0x1C12, 0, 0), 0U);
  ASSERT_EQ(write<std::uint8_t>(0x1C13, 0, 0), 0U);
  ASSERT_EQ(write<std::uint8_t>(0x1600, 0, 0), 0U);
  ASSERT_EQ(write<std::uint8_t>(0x1A00, 0, 0), 0U);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x50000010), kAbortNoObject);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000110), kAbortNoSubindex);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x30000020), kAbortLength);
  EXPECT_EQ(write<std::uint32_t>(0x1600, 1, 0x40000020), 0x06040041U) << "an input";
  EXPECT_EQ(write<std::uint32_t>(0x1A00, 1, 0x10000020), 0x06040041U) << "no process data";
  EXPECT_EQ(write<std::uint32_t>(0x1A00, 1, 0x40000020), 0U);
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 9), 0x06090031U);
  EXPECT_EQ(write<std::uint8_t>(0x1602, 0, 0), kAbortReadOnly) << "fixed";
  EXPECT_EQ(write<std::uint16_t>(0x1C12, 1, 0x1A00), 0x06090030U) << "of the other direction";
  EXPECT_EQ(write<std::uint16_t>(0x1C12, 1, 0x1602), 0U);
  EXPECT_EQ(write<std::uint16_t>(0x1C12, 2, 0x1602), 0U);
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 2), 0x06040043U) << "twice the same";
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 17), 0x06090031U);
}

TEST_F(MappingRules, Other_states_and_too_many_bytes_are_refused) {
  slave_->esc().set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(AlState::SafeOp));
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 0), kAbortState);
  EXPECT_EQ(write<std::uint8_t>(0x1600, 0, 0), kAbortState);
  device_.sii.sync_managers[3].start = kDriveOutputs + 5;
  device_.config.esc.eeprom = sii_image(device_.sii);
  slave_ = std::make_unique<Slave>(device_.config);
  slave_->esc().set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(AlState::PreOp));
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 0), 0U);
  EXPECT_EQ(write<std::uint8_t>(0x1C12, 0, 1), 0x06040042U) << "six bytes before the next SyncManager begins";
}

TEST_F(MappingRules, An_assignment_is_written_at_once_with_complete_access) {
  const std::vector<std::uint8_t> two = {2, 0, 0x02, 0x16, 0x01, 0x16};
  EXPECT_FALSE(slave_->objects().write(0x1C12, 0, true, two));
  EXPECT_EQ(slave_->objects().number(0x1C12, 0), 2U);
  EXPECT_EQ(slave_->objects().number(0x1C12, 1), 0x1602U);
}

}  // namespace
}  // namespace indurop::io::ethercat
