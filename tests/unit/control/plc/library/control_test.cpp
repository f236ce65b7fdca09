// SPDX-License-Identifier: Apache-2.0
// HYSTERESIS, INTEGRAL, DERIVATIVE, PID, RAMP against values calculated by hand.

#include <gtest/gtest.h>
#include <indurop/plc/control.h>

#include <initializer_list>

namespace indurop::iec {
namespace {

constexpr Time kCycle{100 * kMillisecond};

constexpr Scan scan_at(int number) {
  return {number * kCycle.ns + 77};
}

TEST(PlcHysteresis, Switches_outside_of_the_band_only) {
  struct Row {
    float xin1;
    bool q;
  };
  Hysteresis sut;
  sut.xin2 = 10;
  sut.eps = 1;
  for (const auto& [xin1, q] : {Row{10, false}, Row{11, false}, Row{11.5F, true}, Row{9.5F, true}, Row{9, true},
                                Row{8.9F, false}, Row{10.9F, false}, Row{11.1F, true}}) {
    sut.xin1 = xin1;
    sut(Scan{});
    EXPECT_EQ(sut.q, q) << xin1;
  }
}

TEST(PlcIntegral, Sums_over_the_time_in_which_it_runs) {
  Integral sut;
  sut.cycle = kCycle;
  sut.xin = 2;
  sut.x0 = 5;
  sut.r1 = true;
  sut(scan_at(0));
  EXPECT_EQ(sut.xout, 5);
  EXPECT_FALSE(sut.q);
  sut.r1 = false;
  sut(scan_at(1));
  EXPECT_EQ(sut.xout, 5);  // does not run yet
  EXPECT_TRUE(sut.q);
  sut.run = true;
  for (int i = 2; i < 12; ++i) {
    sut(scan_at(i));
  }
  EXPECT_FLOAT_EQ(sut.xout, 7);
  sut.run = false;
  sut(scan_at(12));
  EXPECT_FLOAT_EQ(sut.xout, 7);
}

TEST(PlcIntegral, Takes_the_time_from_the_schedule_if_no_cycle_is_given) {
  Integral sut;
  sut.run = true;
  sut.xin = 1;
  sut(Scan{5 * kSecond});
  EXPECT_EQ(sut.xout, 0);
  sut(Scan{6 * kSecond});
  sut(Scan{9 * kSecond});  // an uneven step
  EXPECT_EQ(sut.xout, 4);
}

TEST(PlcIntegral, Small_steps_are_not_lost_in_a_large_sum) {
  Integral sut;
  sut.run = true;
  sut.cycle = {kMillisecond};
  sut.xin = 1;
  sut.x0 = 100'000;
  sut.r1 = true;
  sut(Scan{});
  sut.r1 = false;
  for (int i = 0; i < 10'000; ++i) {
    sut(Scan{});
  }
  EXPECT_FLOAT_EQ(sut.xout, 100'010);
}

TEST(PlcDerivative, Of_a_straight_line_is_its_slope) {
  Derivative sut;
  sut.run = true;
  for (int i = 0; i < 6; ++i) {
    sut.xin = static_cast<float>(i) * 0.5F;
    sut(scan_at(i));
  }
  EXPECT_FLOAT_EQ(sut.xout, 5);
  sut.run = false;
  sut(scan_at(6));
  EXPECT_EQ(sut.xout, 0);
}

TEST(PlcDerivative, Of_a_step_follows_the_formula_of_four_values) {
  Derivative sut;
  sut.cycle = {kSecond};
  sut.run = true;
  sut(scan_at(0));
  sut.xin = 10;
  // (3 * (xin - x3) + x1 - x2) / 10
  for (const float expected : {3.0F, 4.0F, 3.0F, 0.0F}) {
    sut(scan_at(0));
    EXPECT_FLOAT_EQ(sut.xout, expected);
  }
}

TEST(PlcPid, Each_part_of_the_sum) {
  Pid sut;
  sut.cycle = kCycle;
  sut.pv = 3;
  sut.sp = 1;
  sut.kp = 2;
  sut.x0 = 0.5F;
  sut.tr = 4;
  sut(scan_at(0));
  EXPECT_FLOAT_EQ(sut.xout, 1);  // by hand: kp * x0
  sut.automatic = true;
  sut(scan_at(1));
  // e = 2; the integral began at tr * (x0 - e) = -6 and has gained e * 0.1
  EXPECT_FLOAT_EQ(sut.xout, 2 * (2 + (-6 + 0.2F) / 4));
  sut.td = 1;
  sut.pv = 4;
  sut(scan_at(2));
  // e = 3, the derivative of 2, 2, 2, 3 is (3 * 1 + 0) / (10 * 0.1)
  EXPECT_FLOAT_EQ(sut.xout, 2 * (3 + (-6 + 0.2F + 0.3F) / 4 + 3));
}

TEST(PlcPid, Without_reset_time_it_has_no_integral) {
  Pid sut;
  sut.automatic = true;
  sut.cycle = kCycle;
  sut.pv = 3;
  sut.sp = 1;
  sut.kp = 2;
  for (int i = 0; i < 5; ++i) {
    sut(scan_at(i));
    EXPECT_FLOAT_EQ(sut.xout, 4);
  }
}

TEST(PlcRamp, Goes_from_one_value_to_the_other_in_its_time) {
  for (const Time cycle : {kCycle, Time{}}) {
    Ramp sut;
    sut.x0 = 10;
    sut.x1 = 20;
    sut.tr = {400 * kMillisecond};
    sut.cycle = cycle;
    sut(scan_at(0));
    EXPECT_EQ(sut.xout, 10);
    EXPECT_FALSE(sut.busy);
    sut.run = true;
    int number = 1;
    for (const float expected : {10.0F, 12.5F, 15.0F, 17.5F}) {
      sut(scan_at(number++));
      EXPECT_FLOAT_EQ(sut.xout, expected);
      EXPECT_TRUE(sut.busy);
    }
    sut(scan_at(number++));
    EXPECT_EQ(sut.xout, 20);
    EXPECT_FALSE(sut.busy);
    sut.x1 = 30;  // tracked from then on
    sut(scan_at(number++));
    EXPECT_EQ(sut.xout, 30);
    sut.run = false;
    sut(scan_at(number));
    EXPECT_EQ(sut.xout, 10);
  }
}

}  // namespace
}  // namespace indurop::iec
