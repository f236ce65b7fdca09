// SPDX-License-Identifier: Apache-2.0
// TP, TON, TOF, RTC against timing tables: what the standard's timing diagrams show, retriggering, presets that change,
// and scans that come late.

#include <gtest/gtest.h>
#include <indurop/plc/timers.h>

#include <initializer_list>
#include <type_traits>

namespace indurop::iec {
namespace {

constexpr Time ms(std::int64_t count) {
  return {count * kMillisecond};
}
// No timer may depend on the origin of time.
constexpr std::int64_t kOrigin = 1'234'567'890'123;

struct Row {
  int at_ms = 0;
  bool in = false;
  bool q = false;
  int et_ms = 0;
  int pt_ms = 100;
};

template <class Timer>
void check(std::initializer_list<Row> rows) {
  Timer sut;
  for (const Row& row : rows) {
    sut.in = row.in;
    sut.pt = ms(row.pt_ms);
    sut(Scan{kOrigin + row.at_ms * kMillisecond});
    EXPECT_EQ(sut.q, row.q) << "at " << row.at_ms << " ms";
    EXPECT_EQ(sut.et, ms(row.et_ms)) << "at " << row.at_ms << " ms";
  }
}

TEST(PlcTon, Follows_after_the_delay_and_falls_at_once) {
  check<Ton>({{0, false, false, 0},
              {10, true, false, 0},
              {60, true, false, 50},
              {109, true, false, 99},
              {110, true, true, 100},
              {500, true, true, 100},
              {510, false, false, 0},
              {520, false, false, 0}});
}

TEST(PlcTon, A_shorter_input_does_not_come_through) {
  check<Ton>({{0, true, false, 0},
              {90, true, false, 90},
              {99, false, false, 0},
              {120, true, false, 0},  // begins again
              {219, true, false, 99},
              {220, true, true, 100}});
}

TEST(PlcTon, Starts_with_the_first_call_if_the_input_is_true_then) {
  check<Ton>({{0, true, false, 0}, {100, true, true, 100}});
}

TEST(PlcTon, A_late_scan_ends_it_and_elapsed_time_stands_at_the_preset) {
  check<Ton>({{0, true, false, 0}, {1000, true, true, 100}});
}

TEST(PlcTon, A_preset_that_changes_counts_at_once_but_does_not_take_back_an_output) {
  check<Ton>({{0, true, false, 0, 100},
              {50, true, false, 50, 200},
              {100, true, false, 100, 200},
              {120, true, true, 110, 110},
              {130, true, true, 110, 500},
              {140, false, false, 0, 500}});
}

TEST(PlcTon, Without_a_delay_follows_in_the_same_scan) {
  check<Ton>({{0, true, true, 0, 0}, {10, false, false, 0, 0}, {20, true, true, 0, -5}});
}

TEST(PlcTof, Follows_at_once_and_falls_after_the_delay) {
  check<Tof>({{0, false, false, 0},
              {10, true, true, 0},
              {300, true, true, 0},
              {310, false, true, 0},
              {400, false, true, 90},
              {409, false, true, 99},
              {410, false, false, 100},
              {900, false, false, 100},
              {910, true, true, 0}});
}

TEST(PlcTof, An_input_that_comes_back_in_time_keeps_it) {
  check<Tof>({{0, true, true, 0},
              {10, false, true, 0},
              {80, false, true, 70},
              {90, true, true, 0},
              {100, false, true, 0},
              {190, false, true, 90},
              {200, false, false, 100}});
}

TEST(PlcTof, Is_off_before_its_input_was_ever_true) {
  check<Tof>({{0, false, false, 0}, {1000, false, false, 0}});
}

TEST(PlcTof, Without_a_delay_falls_in_the_same_scan) {
  check<Tof>({{0, true, true, 0, 0}, {10, false, false, 0, 0}});
}

TEST(PlcTp, Gives_one_pulse_whatever_the_input_does_meanwhile) {
  check<Tp>({{0, false, false, 0},
             {10, true, true, 0},
             {30, false, true, 20},
             {50, true, true, 40},  // not retriggered
             {109, true, true, 99},
             {110, true, false, 100},
             {300, true, false, 100},  // one pulse only
             {310, false, false, 0},
             {320, true, true, 0}});
}

TEST(PlcTp, A_short_input_gives_the_whole_pulse) {
  check<Tp>({{0, true, true, 0}, {10, false, true, 10}, {99, false, true, 99}, {100, false, false, 0}});
}

TEST(PlcTp, An_edge_in_the_scan_that_ends_the_pulse_is_too_early) {
  check<Tp>({{0, true, true, 0},
             {50, false, true, 50},
             {100, true, false, 100},
             {110, true, false, 100},
             {120, false, false, 0},
             {130, true, true, 0}});
}

TEST(PlcTp, Without_a_length_there_is_no_pulse) {
  check<Tp>({{0, true, false, 0, 0}, {10, true, false, 0, 0}});
}

TEST(PlcTimers, Time_before_the_start_does_not_count) {
  Ton sut;
  sut.in = true;
  sut.pt = ms(100);
  sut(Scan{kOrigin});
  sut(Scan{0});  // retained over a boot
  EXPECT_EQ(sut.et, ms(0));
  sut(Scan{100 * kMillisecond});
  EXPECT_TRUE(sut.q);
}

TEST(PlcTimers, Are_exact_to_the_nanosecond) {
  Ton sut;
  sut.in = true;
  sut.pt = {250'001};
  sut(Scan{kOrigin});
  sut(Scan{kOrigin + 250'000});
  EXPECT_FALSE(sut.q);
  sut(Scan{kOrigin + 250'001});
  EXPECT_TRUE(sut.q);
  static_assert(std::is_trivially_copyable_v<Ton>);
}

TEST(PlcRtc, Runs_from_the_preset_while_its_input_is_true) {
  const DateTime noon = concat_dt(2024, 2, 29, 12, 0, 0, 0);
  Rtc sut;
  sut(Scan{kOrigin});
  EXPECT_FALSE(sut.q);
  sut.in = true;
  sut.pdt = noon;
  sut(Scan{kOrigin});
  EXPECT_TRUE(sut.q);
  EXPECT_EQ(sut.cdt, noon);
  sut.pdt = {};  // read at the edge only
  sut(Scan{kOrigin + kDay});
  EXPECT_EQ(sut.cdt, concat_dt(2024, 3, 1, 12, 0, 0, 0));
  sut.in = false;
  sut(Scan{kOrigin + 2 * kDay});
  EXPECT_FALSE(sut.q);
  EXPECT_EQ(sut.cdt, concat_dt(2024, 3, 1, 12, 0, 0, 0));
  sut.in = true;
  sut(Scan{kOrigin + 3 * kDay});
  EXPECT_EQ(sut.cdt, DateTime{});
}

}  // namespace
}  // namespace indurop::iec
