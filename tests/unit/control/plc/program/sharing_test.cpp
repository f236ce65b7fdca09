// SPDX-License-Identifier: Apache-2.0
// Compiled programs among other modules: shared variables of a .glb file, tasks, RETAIN: sharing.st.

#include <indurop/indurop.h>

#include <cell.glb.h>
#include <gtest/gtest.h>
#include <plc_test_sharing.glb.h>

#include "module.h"

namespace v = plc_test_sharing;

TEST(PlcSharing, Variables_of_other_modules_are_read_and_written) {
  const indurop::testing::PlcModule sut("plc_test_sharing_fast");
  PLC_ROBOT::I0 = 1;
  PLC_ROBOT::I1 = 7;
  PLC_ROBOT::ROBOT_MODULE_STATE.eState = PLC_ROBOT::STANDBY;
  PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[2] = 21;
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::O0.get(), 1);
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode.get(), 42);
  PLC_ROBOT::I1 = 0;
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::O0.get(), 0);
}

TEST(PlcSharing, Fields_the_program_does_not_write_keep_their_writer) {
  const indurop::testing::PlcModule sut("plc_test_sharing_fast");
  PLC_ROBOT::ROBOT_MODULE_STATE.eState = PLC_ROBOT::STANDBY;
  PLC_ROBOT::ROBOT_MODULE_SERVICE.t_speed = 50;
  PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[2] = 5;
  sut.scan();
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_SERVICE.t_speed.get(), 50);
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode.get(), 10);
}

TEST(PlcSharing, Enumerations_of_a_glb_are_types_and_compared_by_blocks) {
  const indurop::testing::PlcModule slow("plc_test_sharing_slow");
  v::changes = 0;
  for (const auto state : {PLC_ROBOT::DISABLED, PLC_ROBOT::STANDBY, PLC_ROBOT::STANDBY, PLC_ROBOT::MOVING}) {
    PLC_ROBOT::ROBOT_MODULE_STATE.eState = state;
    slow.scan();
    EXPECT_EQ(v::stands_by.get(), state == PLC_ROBOT::STANDBY);
  }
  EXPECT_EQ(v::changes.get(), 2);
}

TEST(PlcSharing, Tasks_are_modules_that_share_the_globals) {
  const indurop::testing::PlcModule fast("plc_test_sharing_fast");
  const indurop::testing::PlcModule slow("plc_test_sharing_slow");
  v::handed = 6;
  v::hours = 100;
  v::first_starts = 0;
  PLC_ROBOT::speed = 1.5;
  fast.scan();
  slow.scan();
  EXPECT_EQ(v::handed.get(), 7);
  EXPECT_EQ(v::hours.get(), 107);
  EXPECT_EQ(v::first_starts.get(), 1);
  EXPECT_EQ(PLC_ROBOT::speed.get(), 3.0);
}
