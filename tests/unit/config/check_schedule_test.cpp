// SPDX-License-Identifier: Apache-2.0
// Schedules that work, schedules that do not, and what --adjust makes of them. No module files are needed.

#include "configuration.h"

namespace indurop::config {
namespace {

using std::chrono::microseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const CheckOptions kScheduleOnly{.files = false, .adjust = false};
const CheckOptions kAdjust{.files = false, .adjust = true};

TEST(Schedule, Sorts_modules_by_operation_and_priority) {
  const Checked sut = check(root(sporadic("late.so", "thread", 2) + non_real("log.exe") + periodic("b.so", "1ms", 2) +
                                 sporadic("early.so", "thread", 1) + periodic("a.so", "1ms", 1)),
                            kScheduleOnly);
  EXPECT_THAT(sut.lines(), IsEmpty());
  EXPECT_THAT(sut.result.periodic, ElementsAre(2, 4));
  EXPECT_THAT(sut.result.table.order, ElementsAre(1, 0));
  EXPECT_THAT(sut.result.sporadic, ElementsAre(3, 0));
  EXPECT_THAT(sut.result.non_real, ElementsAre(1));
}

TEST(Schedule, Without_periodic_modules_is_allowed) {
  const Checked sut = check(root(non_real("log.exe")), kScheduleOnly);
  EXPECT_THAT(sut.lines(), IsEmpty());
  EXPECT_TRUE(sut.result.ok());
  EXPECT_THAT(sut.result.table.slots, IsEmpty());
}

TEST(Schedule, Basic_period_below_the_minimum_proposes_the_nearest_periods) {
  const Checked sut = check(root(periodic("a.so", "100us", 1) + periodic("b.so", "151us", 2)), kScheduleOnly);
  EXPECT_FALSE(sut.result.ok());
  EXPECT_THAT(sut.lines(), ElementsAre(AllOf(StartsWith("m.xml:3:"), HasSubstr("is 1 us, the minimum is 50 us"),
                                             HasSubstr("b period 151 us -> 150 us"), HasSubstr("--adjust applies"))));
}

TEST(Schedule, Adjust_applies_the_proposal) {
  const Checked sut = check(root(periodic("a.so", "100us", 1) + periodic("b.so", "151us", 2)), kAdjust);
  EXPECT_TRUE(sut.result.ok());
  EXPECT_EQ(sut.config.modules[1].period, base::Nanos(microseconds(150)));
  EXPECT_EQ(sut.result.table.basic_period, base::Nanos(microseconds(50)));
  EXPECT_THAT(sut.lines(), ElementsAre(HasSubstr("note: ")));
}

TEST(Schedule, Offset_that_makes_the_basic_period_too_short_is_moved) {
  const std::string xml = root(periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2, "<offset>30us</offset>"));
  EXPECT_THAT(check(xml, kScheduleOnly).lines(), ElementsAre(HasSubstr("b offset 30 us -> 50 us")));
  EXPECT_EQ(check(xml, kAdjust).result.table.basic_period, base::Nanos(microseconds(50)));
}

TEST(Schedule, Adjusting_offsets_near_the_longest_period_does_not_overflow) {
  const std::string longest = "9223372036854775807";
  const std::string offset = "<offset>9223372036854775806</offset>";
  const Checked sut =
      check(root("<minimum_period>9000000000s</minimum_period>" + periodic("a.so", longest, 1, offset)), kAdjust);
  EXPECT_TRUE(sut.result.ok());
  EXPECT_EQ(sut.config.modules[0].offset, base::Nanos(0));
}

TEST(Schedule, Minimum_period_of_the_file_counts) {
  const std::string one = periodic("a.so", "20us", 1);
  EXPECT_FALSE(check(root(one), kScheduleOnly).result.ok());
  EXPECT_TRUE(check(root("<minimum_period>20us</minimum_period>" + one), kScheduleOnly).result.ok());
}

TEST(Schedule, Adjusted_schedules_always_work) {
  for (const char* period : {"1ns", "49999ns", "50001ns", "123457ns", "1.000001s", "9223372036854775807"}) {
    for (const char* offset : {"0", "1ns"}) {
      const Checked sut = check(
          root(periodic("a.so", "100us", 1) + periodic("c.so", "70us", 3) +
               periodic("b.so", "2s", 2, "<offset>" + std::string(offset) + "</offset>") + periodic("d.so", period, 2)),
          kAdjust);
      for (const std::string& line : sut.lines()) {
        EXPECT_THAT(line, testing::Not(HasSubstr("minimum is 50 us; nearest")));
      }
      if (sut.result.ok()) {
        EXPECT_GE(sut.result.table.basic_period, base::Nanos(microseconds(50))) << period;
      }
    }
  }
}

TEST(Schedule, Macro_period_beyond_292_years_is_an_error_naming_the_period) {
  const Checked sut = check(root("<minimum_period>1ns</minimum_period>" + periodic("a.so", "9223372036854775807", 1) +
                                 periodic("b.so", "1ms", 2)),
                            kScheduleOnly);
  EXPECT_THAT(sut.lines(), ElementsAre(AllOf(HasSubstr("error: the macro period"), HasSubstr("292 years"))));
}

TEST(Schedule, Very_long_macro_period_is_a_warning_with_a_hint) {
  const Checked sut = check(root(periodic("a.so", "1ms", 1) + periodic("b.so", "2ms", 2) +
                                 periodic("c.so", "100001us", 3) + "<minimum_period>1us</minimum_period>"),
                            kScheduleOnly);
  EXPECT_TRUE(sut.result.ok());
  EXPECT_THAT(sut.lines(), ElementsAre(AllOf(HasSubstr("warning: the macro period"),
                                             HasSubstr("without the period 100.001 ms of c it would be 2 ms"))));
}

TEST(Schedule, More_bands_than_priority_levels_are_an_error) {
  std::string many;
  for (int i = 0; i < 100; ++i) {
    many += periodic("m" + std::to_string(i) + ".so", i % 2 == 0 ? "1ms" : "2ms", i);
  }
  EXPECT_THAT(check(root(many), kScheduleOnly).lines(), ElementsAre(HasSubstr("priority levels")));

  std::string shared;
  for (int i = 0; i < 256; ++i) {
    shared += periodic("m" + std::to_string(i) + ".so", "1ms", i);
  }
  EXPECT_THAT(check(root(shared), kScheduleOnly).lines(), IsEmpty());
}

TEST(Schedule, Core_that_does_not_exist_is_an_error_where_the_files_are) {
  const std::string xml = root("<core>4095</core>" + periodic("a.so", "1ms", 1, "<core>4094</core>"));
  EXPECT_THAT(check(xml, kScheduleOnly).lines(), IsEmpty());
  EXPECT_THAT(check(xml, CheckOptions{}).lines(), testing::IsSupersetOf({HasSubstr("processor 4095 does not exist"),
                                                                         HasSubstr("processor 4094 does not exist")}));
}

TEST(Schedule, Spinning_all_the_time_is_a_warning) {
  const std::string xml = root("<spin>95us</spin>" + periodic("a.so", "100us", 1));
  EXPECT_THAT(check(xml, CheckOptions{}).lines(), testing::Contains(HasSubstr("warning: <spin>: 95 us")));
}

}  // namespace
}  // namespace indurop::config
