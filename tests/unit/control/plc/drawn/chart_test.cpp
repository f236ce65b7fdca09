// SPDX-License-Identifier: Apache-2.0
// A sequential function chart, run: evolution of the steps, qualifiers of the actions, times.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_beremiz_chart.glb.h>

#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use
using testing::PlcModule;
namespace press = plc_test_beremiz_chart;

class PlcChart : public ::testing::Test {
 protected:
  PlcChart() {
    press::press_Go = false;
    press::press_Down = false;
    press::press_Clamped = false;
    press::press_Fault = false;
    press::press_Horn = false;
    press::press_Lamp = false;
    press::press_Strokes = 0;
    // Steps are shared variables too.
    press::press_Ready.X = true;
    press::press_Lower.X = false;
    press::press_Clamp.X = false;
    press::press_Raise.X = false;
    press::press_Alarm.X = false;
  }
  void scan() {
    sut_.scan(at_);
    at_ += 100ms;
  }
  // Lower and Clamp are active.
  void begin() {
    scan();
    press::press_Go = true;
    scan();
    press::press_Go = false;
  }

  PlcModule sut_{"plc_test_beremiz_chart"};
  std::chrono::milliseconds at_{1000};
};

TEST_F(PlcChart, The_initial_step_runs_in_the_first_scan_even_if_its_transition_is_true) {
  press::press_Go = true;
  scan();
  EXPECT_TRUE(press::press_Released.get());
  EXPECT_EQ(press::press_Strokes.get(), 0);
  scan();
  EXPECT_FALSE(press::press_Released.get()) << "the action's last scan resets its variable";
  EXPECT_EQ(press::press_Strokes.get(), 1);
}

TEST_F(PlcChart, A_pulse_runs_once) {
  begin();
  for (int i = 0; i < 5; ++i) {
    scan();
  }
  EXPECT_EQ(press::press_Strokes.get(), 1);
}

TEST_F(PlcChart, A_delayed_action_waits) {
  begin();  // the step is active since this scan
  for (int i = 1; i < 5; ++i) {
    scan();
    EXPECT_FALSE(press::press_Clamped.get()) << i;
  }
  scan();
  EXPECT_TRUE(press::press_Clamped.get()) << "500 ms later";
}

TEST_F(PlcChart, A_limited_action_ends) {
  begin();
  bool before = press::press_Lamp.get();
  int flashes = 1;  // in the scan that made the step active
  for (int i = 1; i < 30; ++i) {
    scan();
    flashes += press::press_Lamp.get() != before ? 1 : 0;
    before = press::press_Lamp.get();
  }
  EXPECT_EQ(flashes, 21) << "2 s of 100 ms, the last scan included";
}

TEST_F(PlcChart, A_simultaneous_convergence_needs_all_its_steps) {
  begin();
  press::press_Down = true;
  for (int i = 1; i <= 5; ++i) {
    scan();
  }
  EXPECT_TRUE(press::press_Clamped.get());
  press::press_Strokes = 0;
  scan();  // both: Raise
  press::press_Fault = true;
  scan();  // the transition with priority 1: Alarm
  EXPECT_TRUE(press::press_Horn.get());
  press::press_Fault = false;
  scan();  // Raise again, the stored action goes on
  EXPECT_TRUE(press::press_Horn.get());
  for (int i = 1; i <= 10; ++i) {
    scan();
  }
  EXPECT_TRUE(press::press_Horn.get()) << "Raise.T is 1 s, not more";
  scan();
  EXPECT_TRUE(press::press_Released.get());
  EXPECT_FALSE(press::press_Horn.get()) << "the initial step resets it";
}

}  // namespace
}  // namespace indurop
