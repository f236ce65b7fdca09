// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/drive.h"

#include <gtest/gtest.h>

namespace indurop::robot {
namespace {

using State = Drive::State;
using Want = Drive::Want;

constexpr std::uint16_t kSwitchOnDisabled = 0x0240;
constexpr std::uint16_t kReady = 0x0231;
constexpr std::uint16_t kSwitchedOn = 0x0233;
constexpr std::uint16_t kEnabled = 0x0237;
constexpr std::uint16_t kQuickStopActive = 0x0217;
constexpr std::uint16_t kFaultReaction = 0x021F;
constexpr std::uint16_t kFault = 0x0218;

TEST(Drive, States_of_the_status_word) {
  EXPECT_EQ(Drive::state_of(0x0200), State::NotReady);
  EXPECT_EQ(Drive::state_of(kSwitchOnDisabled), State::SwitchOnDisabled);
  EXPECT_EQ(Drive::state_of(kReady), State::ReadyToSwitchOn);
  EXPECT_EQ(Drive::state_of(kSwitchedOn), State::SwitchedOn);
  EXPECT_EQ(Drive::state_of(kEnabled), State::OperationEnabled);
  EXPECT_EQ(Drive::state_of(kQuickStopActive), State::QuickStop);
  EXPECT_EQ(Drive::state_of(kFaultReaction), State::FaultReaction);
  EXPECT_EQ(Drive::state_of(kFault), State::Fault);
}

std::uint16_t control_after(std::uint16_t status, Want want) {
  Drive sut;
  DriveIn in;
  in.status = status;
  sut.step(in, want);
  return sut.control();
}

TEST(Drive, One_transition_after_the_other_to_operation) {
  EXPECT_EQ(control_after(kSwitchOnDisabled, Want::On), 0x06);
  EXPECT_EQ(control_after(kReady, Want::On), 0x07);
  EXPECT_EQ(control_after(kSwitchedOn, Want::On), 0x0F);
  EXPECT_EQ(control_after(kEnabled, Want::On), 0x0F);
  EXPECT_EQ(control_after(kFault, Want::On), 0x00);
  EXPECT_EQ(control_after(kEnabled, Want::Off), 0x00);
  EXPECT_EQ(control_after(kEnabled, Want::QuickStop), 0x02);
  EXPECT_EQ(control_after(kReady, Want::QuickStop), 0x00);
}

TEST(Drive, A_fault_is_acknowledged_with_a_rising_edge) {
  Drive sut;
  DriveIn in;
  in.status = kFault;
  sut.step(in, Want::On);
  EXPECT_EQ(sut.control(), 0x00);
  sut.reset();
  sut.step(in, Want::On);
  EXPECT_EQ(sut.control(), 0x80);
  sut.step(in, Want::On);
  EXPECT_EQ(sut.control(), 0x00);
  in.status = kSwitchOnDisabled;
  sut.step(in, Want::On);
  EXPECT_EQ(sut.control(), 0x06);
}

TEST(Drive, Homing_starts_only_in_its_mode) {
  Drive sut;
  DriveIn in;
  in.status = kEnabled;
  in.mode = 8;
  sut.home(true);
  sut.step(in, Want::On);
  EXPECT_EQ(sut.mode(), 6);
  EXPECT_EQ(sut.control(), 0x0F);
  in.mode = 6;
  in.status = kEnabled | 1U << 12;  // of an earlier homing
  sut.step(in, Want::On);
  EXPECT_EQ(sut.control(), 0x1F);
  EXPECT_FALSE(sut.home_found());
  in.status = kEnabled;
  sut.step(in, Want::On);
  EXPECT_FALSE(sut.home_found());
  in.status = kEnabled | 1U << 12;
  sut.step(in, Want::On);
  EXPECT_TRUE(sut.home_found());
  sut.home(false);
  sut.step(in, Want::On);
  EXPECT_EQ(sut.mode(), 8);
}

}  // namespace
}  // namespace indurop::robot
