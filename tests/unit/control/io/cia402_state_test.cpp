// SPDX-License-Identifier: Apache-2.0
// The state machine against the standard's table of transitions.
#include "control/io/cia402_state.h"

#include <gtest/gtest.h>

#include <vector>

namespace indurop::io {
namespace {

using S = DriveState;

constexpr std::uint16_t kDisableVoltage = 0x00;
constexpr std::uint16_t kQuickStop = 0x02;
constexpr std::uint16_t kShutdown = 0x06;
constexpr std::uint16_t kSwitchOn = 0x07;
constexpr std::uint16_t kEnable = 0x0F;

// A machine in the given state, reached by commands and events only.
DriveStateMachine in(S state) {
  DriveStateMachine machine;
  const auto steps = [&](const std::vector<std::uint16_t>& controls) {
    for (const std::uint16_t control : controls) {
      machine.step(control, true);
    }
  };
  switch (state) {
    case S::NotReady:
      break;
    case S::SwitchOnDisabled:
      steps({0});
      break;
    case S::ReadyToSwitchOn:
      steps({0, kShutdown});
      break;
    case S::SwitchedOn:
      steps({0, kShutdown, kSwitchOn});
      break;
    case S::OperationEnabled:
      steps({0, kShutdown, kSwitchOn, kEnable});
      break;
    case S::QuickStopActive:
      steps({0, kShutdown, kSwitchOn, kEnable, kQuickStop});
      break;
    case S::FaultReaction:
      steps({0});
      machine.fail(kFollowingError);
      break;
    case S::Fault:
      steps({0});
      machine.fail(kFollowingError);
      steps({0});
      break;
  }
  EXPECT_EQ(machine.state(), state);
  return machine;
}

struct Row {
  S from;
  std::uint16_t control;
  bool standing;
  S to;
};

TEST(Cia402State, Transitions_are_those_of_the_standard) {
  const std::vector<Row> table{
      {S::NotReady, kDisableVoltage, true, S::SwitchOnDisabled},
      {S::NotReady, kEnable, true, S::SwitchOnDisabled},
      {S::SwitchOnDisabled, kShutdown, true, S::ReadyToSwitchOn},
      {S::SwitchOnDisabled, kSwitchOn, true, S::SwitchOnDisabled},
      {S::SwitchOnDisabled, kEnable, true, S::SwitchOnDisabled},
      {S::ReadyToSwitchOn, kShutdown, true, S::ReadyToSwitchOn},
      {S::ReadyToSwitchOn, kSwitchOn, true, S::SwitchedOn},
      {S::ReadyToSwitchOn, kEnable, true, S::SwitchedOn},
      {S::ReadyToSwitchOn, kQuickStop, true, S::SwitchOnDisabled},
      {S::ReadyToSwitchOn, kDisableVoltage, true, S::SwitchOnDisabled},
      {S::SwitchedOn, kShutdown, true, S::ReadyToSwitchOn},
      {S::SwitchedOn, kSwitchOn, true, S::SwitchedOn},
      {S::SwitchedOn, kEnable, true, S::OperationEnabled},
      {S::SwitchedOn, kQuickStop, true, S::SwitchOnDisabled},
      {S::SwitchedOn, kDisableVoltage, true, S::SwitchOnDisabled},
      {S::OperationEnabled, kShutdown, false, S::ReadyToSwitchOn},
      {S::OperationEnabled, kSwitchOn, false, S::SwitchedOn},
      {S::OperationEnabled, kEnable, false, S::OperationEnabled},
      {S::OperationEnabled, kQuickStop, false, S::QuickStopActive},
      {S::OperationEnabled, kDisableVoltage, false, S::SwitchOnDisabled},
      {S::QuickStopActive, kQuickStop, false, S::QuickStopActive},
      {S::QuickStopActive, kEnable, false, S::QuickStopActive},
      {S::QuickStopActive, kDisableVoltage, false, S::SwitchOnDisabled},
      {S::QuickStopActive, kQuickStop, true, S::SwitchOnDisabled},
      {S::FaultReaction, kFaultReset, false, S::FaultReaction},
      {S::FaultReaction, kEnable, true, S::Fault},
      {S::Fault, kEnable, true, S::Fault},
      {S::Fault, kFaultReset, true, S::SwitchOnDisabled},
  };
  for (const Row& row : table) {
    DriveStateMachine sut = in(row.from);
    sut.step(row.control, row.standing);
    EXPECT_EQ(sut.state(), row.to) << "from " << static_cast<int>(row.from) << " with " << row.control;
  }
}

TEST(Cia402State, Statuswords_have_the_bits_of_the_standard) {
  const auto expect = [](S state, unsigned mask, unsigned bits) {
    EXPECT_EQ(in(state).status() & mask, bits) << "state " << static_cast<int>(state);
  };
  expect(S::NotReady, 0x4F, 0x00);
  expect(S::SwitchOnDisabled, 0x4F, 0x40);
  expect(S::ReadyToSwitchOn, 0x6F, 0x21);
  expect(S::SwitchedOn, 0x6F, 0x23);
  expect(S::OperationEnabled, 0x6F, 0x27);
  expect(S::QuickStopActive, 0x6F, 0x07);
  expect(S::FaultReaction, 0x4F, 0x0F);
  expect(S::Fault, 0x4F, 0x08);
}

TEST(Cia402State, A_fault_is_reset_by_the_edge_not_by_the_level) {
  DriveStateMachine sut = in(S::OperationEnabled);
  sut.step(kFaultReset | kEnable, false);
  sut.fail(kFollowingError);
  EXPECT_EQ(sut.error(), kFollowingError);
  sut.step(kFaultReset, true);
  sut.step(kFaultReset, true);
  EXPECT_EQ(sut.state(), S::Fault);
  sut.step(0, true);
  sut.step(kFaultReset, true);
  EXPECT_EQ(sut.state(), S::SwitchOnDisabled);
  EXPECT_EQ(sut.error(), 0);
}

TEST(Cia402State, The_first_error_stays) {
  DriveStateMachine sut = in(S::OperationEnabled);
  sut.fail(1);
  sut.fail(2);
  EXPECT_EQ(sut.error(), 1);
}

}  // namespace
}  // namespace indurop::io
