// SPDX-License-Identifier: Apache-2.0
// A ladder on the shared variables of a robot, which are short: contacts and coils take them as they are.

#include <indurop/indurop.h>

#include <figure11.glb.h>
#include <gtest/gtest.h>

#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using testing::PlcModule;

TEST(PlcFigure12, A_contact_is_closed_unless_the_number_is_zero_and_a_coil_writes_one_or_zero) {
  const PlcModule sut("plc_test_figure12");
  PLC_ROBOT::O0 = 77;
  for (const int input : {0, 1, -1, 256, 0}) {
    PLC_ROBOT::I0 = static_cast<short>(input);
    PLC_ROBOT::I1 = 0;
    sut.scan();
    EXPECT_EQ(PLC_ROBOT::O0.get(), input != 0 ? 1 : 0) << input;
    PLC_ROBOT::I1 = 2;
    sut.scan();
    EXPECT_EQ(PLC_ROBOT::O0.get(), 0) << "the negated contact is open";
  }
}

TEST(PlcFigure12, Set_reset_and_negated_coils_write_numbers_too) {
  const PlcModule sut("plc_test_figure12");
  PLC_ROBOT::I0 = 4;
  PLC_ROBOT::latched = 0;
  auto state = PLC_ROBOT::ROBOT_MODULE_STATE.get();
  state.MotionDone = 5;
  state.Busy = 0;
  PLC_ROBOT::ROBOT_MODULE_STATE = state;
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::latched.get(), 1);
  EXPECT_EQ(PLC_ROBOT::O1.get(), 0);
  state.Busy = 1;
  PLC_ROBOT::ROBOT_MODULE_STATE = state;
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::latched.get(), 1) << "it stays set";
  EXPECT_EQ(PLC_ROBOT::O1.get(), 1);
  PLC_ROBOT::I0 = 0;  // its falling edge resets
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::latched.get(), 0);
}

TEST(PlcFigure12, The_rising_edge_of_a_number_is_its_step_away_from_zero) {
  const PlcModule sut("plc_test_figure12");
  PLC_ROBOT::msgRobotServiceEditNum = 0;
  for (const int input : {0, 3, 4, 0, -7, 0}) {
    PLC_ROBOT::I1 = static_cast<short>(input);
    sut.scan();
  }
  EXPECT_EQ(PLC_ROBOT::msgRobotServiceEditNum.get(), 2);
}

}  // namespace
}  // namespace indurop
