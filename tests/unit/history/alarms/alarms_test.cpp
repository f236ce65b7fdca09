// SPDX-License-Identifier: Apache-2.0
// Alarms: every transition, the history on disk, conditions over time, and what people do.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/rt/clock.h"
#include "history/alarms/alarm_list.h"
#include "history/alarms/alarm_orders.h"
#include "history/alarms/alarm_watch.h"

namespace indurop::alarms {
namespace {

using State = AlarmState;
using Event = AlarmEvent;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

// ISA-18.2, figure "alarm state transition diagram": normal, unacknowledged, acknowledged, returned to normal
// unacknowledged, shelved. What is not listed is no transition.
TEST(AlarmState_, Follows_the_table_of_ISA_18_2) {
  struct Line {
    State from;
    Event event;
    State to;
  };
  constexpr std::array kTable{
      Line{State::Normal, Event::Raised, State::Unacknowledged},
      Line{State::Unacknowledged, Event::Acknowledged, State::Acknowledged},
      Line{State::Unacknowledged, Event::Cleared, State::Returned},
      Line{State::Acknowledged, Event::Cleared, State::Normal},
      Line{State::Returned, Event::Acknowledged, State::Normal},
      Line{State::Returned, Event::Raised, State::Unacknowledged},
      Line{State::Normal, Event::Shelved, State::Shelved},
      Line{State::Unacknowledged, Event::Shelved, State::Shelved},
      Line{State::Acknowledged, Event::Shelved, State::Shelved},
      Line{State::Returned, Event::Shelved, State::Shelved},
      Line{State::Shelved, Event::Shelved, State::Shelved},
      Line{State::Shelved, Event::Unshelved, State::Normal},
      Line{State::Unacknowledged, Event::Removed, State::Normal},
      Line{State::Acknowledged, Event::Removed, State::Normal},
      Line{State::Returned, Event::Removed, State::Normal},
      Line{State::Shelved, Event::Removed, State::Normal},
  };
  for (const State state :
       {State::Normal, State::Unacknowledged, State::Acknowledged, State::Returned, State::Shelved}) {
    for (const Event event :
         {Event::Raised, Event::Cleared, Event::Acknowledged, Event::Shelved, Event::Unshelved, Event::Removed}) {
      const auto* const line = std::find_if(kTable.begin(), kTable.end(),
                                            [&](const Line& one) { return one.from == state && one.event == event; });
      const auto expected = line == kTable.end() ? std::nullopt : std::optional(line->to);
      EXPECT_EQ(after(state, event), expected) << word_of(state) << " " << word_of(event);
    }
  }
}

class Alarms : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "alarms_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] AlarmJournal journal(std::size_t max_bytes = 1U << 20U) const { return {folder_, max_bytes}; }

  static AlarmEntry entry(const std::string& alarm, Event event) {
    AlarmEntry out;
    out.wall_ns = rt::wall_ns();
    out.alarm = alarm;
    out.event = event;
    out.text = "text of " + alarm;
    return out;
  }
  static std::string add(AlarmJournal& to, const std::string& alarm, Event event) {
    return to.change([&](const AlarmBook& /*book*/) { return std::vector{entry(alarm, event)}; });
  }
  static std::vector<DeclaredAlarm> declared() {
    DeclaredAlarm door;
    door.name = door.part = "press::door";
    door.alarm.text = "the door is open";
    DeclaredAlarm oil;
    oil.name = "press::oil > 80";
    oil.part = "press::oil";
    return {door, oil};
  }

  std::filesystem::path folder_;
};

TEST_F(Alarms, Stand_as_before_when_the_history_is_read_again) {
  auto first = journal();
  EXPECT_EQ(add(first, "a", Event::Raised), "");
  EXPECT_EQ(add(first, "b", Event::Raised), "");
  EXPECT_EQ(add(first, "b", Event::Acknowledged), "");
  auto again = journal();
  again.refresh();
  EXPECT_EQ(again.book().find("a").state, State::Unacknowledged);
  EXPECT_EQ(again.book().find("b").state, State::Acknowledged);
  EXPECT_EQ(again.book().find("a").count, 1U);
  EXPECT_EQ(again.history(2).front().alarm, "b");
}

TEST_F(Alarms, A_line_cut_off_by_a_loss_of_power_costs_only_itself) {
  auto first = journal();
  EXPECT_EQ(add(first, "a", Event::Raised), "");
  std::ofstream(folder_ / "events.jsonl", std::ios::app) << R"({"wall_ns":1,"alarm":"b","ev)";
  auto second = journal();
  EXPECT_EQ(add(second, "c", Event::Raised), "");
  auto sut = journal();
  sut.refresh();
  EXPECT_EQ(sut.book().standing().size(), 2U);
  EXPECT_EQ(sut.book().find("c").state, State::Unacknowledged);
  first.refresh();
  EXPECT_EQ(first.book().standing().size(), 2U);
}

TEST_F(Alarms, The_history_is_cut_and_nothing_that_stands_is_forgotten) {
  constexpr std::size_t kSmall = 2000;
  auto sut = journal(kSmall);
  auto reader = journal(kSmall);
  EXPECT_EQ(add(sut, "stays", Event::Raised), "");
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(add(sut, "flickers", i % 2 == 0 ? Event::Raised : Event::Cleared), "");
    reader.refresh();
    EXPECT_EQ(reader.book().find("stays").state, State::Unacknowledged) << i;
  }
  EXPECT_LT(std::filesystem::file_size(folder_ / "events.jsonl"), 2 * kSmall);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "events.jsonl.1"));
  EXPECT_EQ(reader.book().find("flickers").count, 50U);
  EXPECT_EQ(reader.book().find("flickers").state, State::Returned);
}

TEST_F(Alarms, One_process_at_a_time_watches) {
  auto other = journal();
  {
    auto sut = journal();
    EXPECT_FALSE(other.watched());
    EXPECT_TRUE(sut.become_watcher());
    EXPECT_TRUE(sut.watched());
    EXPECT_TRUE(other.watched());
    EXPECT_FALSE(other.become_watcher());
  }
  EXPECT_FALSE(other.watched());
  EXPECT_TRUE(other.become_watcher());
}

TEST_F(Alarms, What_cannot_be_kept_is_said) {
  std::ofstream(folder_ / "file") << "";
  AlarmJournal sut(folder_ / "file" / "alarms", 1000);
  EXPECT_THAT(add(sut, "a", Event::Raised), HasSubstr("Not a directory"));
}

TEST_F(Alarms, Are_acknowledged_by_name_part_or_glob) {
  auto sut = journal();
  EXPECT_EQ(add(sut, "press::door", Event::Raised), "");
  EXPECT_EQ(add(sut, "press::oil > 80", Event::Raised), "");
  AlarmOrder order;
  order.names = {"oil"};
  order.who = "ana";
  order.reason = "seen";
  auto done = carry_out(sut, declared(), order);
  ASSERT_TRUE(done.ok());
  EXPECT_THAT(*done, ElementsAre("press::oil > 80"));
  EXPECT_EQ(sut.book().find("press::oil > 80").last.who, "ana");
  order.names = {"press::*"};
  done = carry_out(sut, declared(), order);
  ASSERT_TRUE(done.ok());
  EXPECT_THAT(*done, ElementsAre("press::door"));
  done = carry_out(sut, declared(), order);
  ASSERT_TRUE(done.ok());
  EXPECT_THAT(*done, IsEmpty());
}

TEST_F(Alarms, Of_modules_are_acknowledged_by_their_whole_names) {
  auto sut = journal();
  EXPECT_EQ(add(sut, module_alarm("Robot"), Event::Raised), "");
  EXPECT_EQ(add(sut, module_alarm("estop"), Event::Raised), "");
  AlarmOrder order;
  order.names = {"module Robot"};
  auto done = carry_out(sut, declared(), order);
  ASSERT_TRUE(done.ok());
  EXPECT_THAT(*done, ElementsAre("module Robot"));
  order.names = {"module"};
  done = carry_out(sut, declared(), order);
  EXPECT_FALSE(done.ok());
}

TEST_F(Alarms, A_wrong_name_changes_nothing) {
  auto sut = journal();
  EXPECT_EQ(add(sut, "press::door", Event::Raised), "");
  AlarmOrder order;
  order.names = {"door", "dor", "nothing"};
  const auto done = carry_out(sut, declared(), order);
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().texts.size(), 2U);
  EXPECT_EQ(sut.book().find("press::door").state, State::Unacknowledged);
}

TEST_F(Alarms, Are_shelved_for_a_time) {
  auto sut = journal();
  AlarmOrder order;
  order.what = Event::Shelved;
  order.names = {"door"};
  order.for_ns = 60 * kSecond;
  const std::int64_t before = rt::wall_ns();
  ASSERT_TRUE(carry_out(sut, declared(), order).ok());
  EXPECT_GE(sut.book().find("press::door").last.until_ns, before + order.for_ns);
  const auto list = list_alarms(declared(), sut.book(), false);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].record.state, State::Shelved);
  EXPECT_EQ(sut.book().counts().shelved, 1U);
  EXPECT_FALSE(sut.book().counts().worst);
}

TEST_F(Alarms, Those_that_need_action_come_first) {
  AlarmBook book;
  for (const auto& [name, priority] : {std::pair("low", schema::Priority::Low),
                                       {"high", schema::Priority::High},
                                       {"seen", schema::Priority::Critical}}) {
    AlarmEntry one = entry(name, Event::Raised);
    one.priority = priority;
    book.add(one);
  }
  book.add(entry("seen", Event::Acknowledged));
  std::vector<std::string> names;
  for (const ListedAlarm& one : list_alarms({}, book, true)) {
    names.push_back(one.name);
  }
  EXPECT_THAT(names, ElementsAre("high", "low", "seen"));
  EXPECT_EQ(sentence_of(book.counts()), "3 alarms are active, 2 are not acknowledged");
  EXPECT_EQ(sentence_of({0, 1, 2, {}}), "1 alarm is not acknowledged, 2 are shelved");
}

TEST(AlarmCondition_, Waits_for_its_delay_and_for_its_end) {
  schema::Alarm alarm;
  alarm.comparison = schema::Comparison::Greater;
  alarm.limit = 80;
  alarm.delay_ns = 2 * kSecond;
  AlarmCondition sut;
  EXPECT_FALSE(sut.evaluate(alarm, 90, 0, false));
  EXPECT_FALSE(sut.evaluate(alarm, 70, 1 * kSecond, false));
  EXPECT_FALSE(sut.evaluate(alarm, 90, 2 * kSecond, false));
  EXPECT_FALSE(sut.evaluate(alarm, 90, 4 * kSecond - 1, false));
  EXPECT_TRUE(sut.evaluate(alarm, 90, 4 * kSecond, false));
  EXPECT_TRUE(sut.evaluate(alarm, 70, 5 * kSecond, false));
  EXPECT_TRUE(sut.evaluate(alarm, 90, 5 * kSecond + kBackForNs / 2, false));
  EXPECT_TRUE(sut.evaluate(alarm, 70, 7 * kSecond, false));
  EXPECT_FALSE(sut.evaluate(alarm, 70, 7 * kSecond + kBackForNs, false));
}

TEST(AlarmCondition_, Goes_on_where_another_watcher_ended) {
  schema::Alarm alarm;
  AlarmCondition sut;
  EXPECT_TRUE(sut.evaluate(alarm, 1, 0, true));
  AlarmCondition gone;
  EXPECT_TRUE(gone.evaluate(alarm, 0, 0, true));
  EXPECT_FALSE(gone.evaluate(alarm, 0, kBackForNs, true));
}

}  // namespace
}  // namespace indurop::alarms
