// SPDX-License-Identifier: Apache-2.0
// Ladders, run: contacts, coils, branches, boxes with EN, jumps.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_codesys_ladder.glb.h>
#include <plc_test_openplc_ladder.glb.h>

#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use
using testing::PlcModule;
namespace house = plc_test_openplc_ladder;
namespace tank = plc_test_codesys_ladder;

TEST(PlcLadder, Series_is_and_parallel_is_or) {
  const PlcModule sut("plc_test_openplc_ladder");
  for (const bool door : {false, true}) {
    for (const bool key : {false, true}) {
      house::instance_door = door;
      house::instance_key = key;
      sut.scan();
      EXPECT_EQ(house::instance_lamp.get(), !(door && !key)) << door << key;  // its coil is negated
      EXPECT_EQ(house::instance_bell.get(), door);
    }
  }
  house::instance_door = false;
  house::instance_key = false;
}

TEST(PlcLadder, Falling_edge_contact_closes_for_one_scan) {
  const PlcModule sut("plc_test_openplc_ladder");
  house::instance_window = false;
  sut.scan();
  EXPECT_TRUE(house::instance_lamp.get()) << "no edge in the first scan";
  house::instance_window = true;
  sut.scan();
  EXPECT_TRUE(house::instance_lamp.get());
  house::instance_window = false;
  sut.scan();
  EXPECT_FALSE(house::instance_lamp.get());
  sut.scan();
  EXPECT_TRUE(house::instance_lamp.get());
}

TEST(PlcLadder, Rising_edge_coil_is_true_for_one_scan) {
  const PlcModule sut("plc_test_openplc_ladder");
  house::instance_night = true;
  house::instance_dog = true;
  sut.scan();
  EXPECT_TRUE(house::instance_alarm.get());
  house::instance_guard = true;  // the other branch: the power stays
  sut.scan();
  EXPECT_FALSE(house::instance_alarm.get());
  house::instance_night = false;
  sut.scan();
  house::instance_night = true;
  sut.scan();
  EXPECT_TRUE(house::instance_alarm.get());
  house::instance_night = false;
  house::instance_dog = false;
  house::instance_guard = false;
}

TEST(PlcLadder, Boxes_are_evaluated_only_while_enabled) {
  const PlcModule sut("plc_test_openplc_ladder");
  house::instance_door = false;
  house::instance_visits = 7;
  sut.scan(10ms);
  EXPECT_EQ(house::instance_visits.get(), 7);
  house::instance_door = true;
  sut.scan(20ms);
  sut.scan(30ms);
  EXPECT_EQ(house::instance_visits.get(), 9);
  EXPECT_TRUE(house::instance_light.get());
  house::instance_door = false;  // the timer is no longer evaluated: its output stays
  sut.scan(40ms);
  sut.scan(5000ms);
  EXPECT_EQ(house::instance_visits.get(), 9);
  EXPECT_TRUE(house::instance_light.get());
}

TEST(PlcLadder, Comparison_in_the_rung_gates_the_power) {
  const PlcModule sut("plc_test_codesys_ladder");
  tank::PLC_PRG_bFill = true;
  tank::PLC_PRG_rLevel = 12.5F;
  sut.scan();
  EXPECT_TRUE(tank::PLC_PRG_bPump.get());
  tank::PLC_PRG_bFill = false;  // holds itself
  tank::PLC_PRG_bHold = false;  // which the last rung has set
  sut.scan();
  EXPECT_TRUE(tank::PLC_PRG_bPump.get());
  tank::PLC_PRG_bHold = false;
  tank::PLC_PRG_rLevel = 80.0F;
  sut.scan();
  EXPECT_FALSE(tank::PLC_PRG_bPump.get());
  tank::PLC_PRG_bHold = false;
}

TEST(PlcLadder, Jumps_pass_over_rungs) {
  const PlcModule sut("plc_test_codesys_ladder");
  tank::PLC_PRG_rLevel = 0.0F;
  tank::PLC_PRG_bHold = false;
  tank::PLC_PRG_nFilled = 0;
  for (const bool empty : {false, true}) {
    tank::PLC_PRG_bEmpty = empty;
    tank::PLC_PRG_bFill = true;
    sut.scan();  // the pump starts: one rising edge
    tank::PLC_PRG_bFill = false;
    tank::PLC_PRG_rLevel = 100.0F;
    sut.scan();
    tank::PLC_PRG_rLevel = 0.0F;
    tank::PLC_PRG_bHold = false;
    EXPECT_EQ(tank::PLC_PRG_nFilled.get(), 1) << "with bEmpty the addition is jumped over";
  }
}

}  // namespace
}  // namespace indurop
