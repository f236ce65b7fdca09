// SPDX-License-Identifier: Apache-2.0

#include "store/tape/track.h"

#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <random>
#include <thread>

#include "store/tape/member.h"
#include "tape_fixture.h"

namespace indurop::tape {
namespace {

using test::bytes_of;
using test::Plant;

// What a reader believes the variables are, from the tape alone.
struct Believed {
  std::map<std::uint32_t, std::vector<std::uint8_t>> values;
  void take(const Run& run) {
    for (const Value& value : run.values) {
      values[value.variable].assign(value.bytes.begin(), value.bytes.end());
    }
  }
};

// The plant's tape is made for 100 ms and runs of 1 ms.
TEST(Track, Holds_the_runs_it_was_made_for_when_everything_changes_in_each) {
  Plant plant("reach", {{"abd", "bcde"}});
  Track& sut = plant.track(0);
  for (std::uint64_t tick = 0; tick < 2000; ++tick) {
    plant.put("a", static_cast<std::uint8_t>(tick));
    plant.put("b", static_cast<std::uint32_t>(tick));
    plant.put("d", static_cast<double>(tick));
    sut.begin();
    sut.clock(1);
    sut.clock(2);
    plant.put("a", static_cast<std::uint8_t>(tick + 1));
    plant.put("b", static_cast<std::uint32_t>(tick + 1));
    plant.put("c", static_cast<double>(tick));
    plant.put("d", static_cast<double>(tick + 1));
    plant.put("e", static_cast<std::uint8_t>(tick));
    sut.end(Plant::at(tick), 0);
    if (tick >= 100) {
      Follower reader = plant.follow();
      tape::Run run;
      ASSERT_TRUE(reader.next(0, run));
      ASSERT_LE(run.tail.tick, tick - 99);
    }
  }
}

TEST(Track, A_run_in_which_its_process_died_is_recorded_as_a_fault) {
  Plant plant("dead", {{"ab", "bc"}});
  Follower reader = plant.follow();
  tape::Run run;
  {
    Member process = Member::open(plant.node(), 0, plant.store()).value();
    process.track().begin();
    process.track().end(Plant::at(0), 0);
    plant.tape().end_of_dead(0, Plant::at(5));
    ASSERT_TRUE(reader.next(0, run));
    EXPECT_FALSE(reader.next(0, run)) << "it was in no run";
    plant.put<std::uint8_t>("a", 3);
    process.track().begin();
    process.track().clock(77);
    process.track().record_answer(5, std::vector<std::uint8_t>{9, 8});
  }
  EXPECT_FALSE(reader.next(0, run));
  plant.tape().end_of_dead(0, Plant::at(1));
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.flags, std::uint32_t{kFaulted});
  EXPECT_EQ(run.tail.number, 1U);
  EXPECT_EQ(run.tail.order, 1U);
  EXPECT_EQ(run.tail.tick, 1U);
  EXPECT_THAT(run.clock, testing::ElementsAre(77));
  ASSERT_EQ(run.answers.size(), 1U);
  ASSERT_EQ(run.values.size(), 1U);
  EXPECT_EQ(run.values[0].variable, plant.index("a"));
  {
    Member again = Member::open(plant.node(), 0, plant.store()).value();
    again.track().begin();
  }
  plant.tape().end_of_dead(0, Plant::at(2));
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.flags, std::uint32_t{kFaulted} | std::uint32_t{kRestarted}) << "in its first run";
  Member third = Member::open(plant.node(), 0, plant.store()).value();
  third.track().begin();
  third.track().end(Plant::at(3), 0);
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.flags, std::uint32_t{kRestarted});
  EXPECT_EQ(run.tail.number, 3U);
}

TEST(Track, Tells_what_a_run_began_with_and_what_it_left) {
  Plant plant("track", {{"ab", "bc"}});
  Track& sut = plant.track(0);
  Follower reader = plant.follow();
  tape::Run run;
  EXPECT_FALSE(reader.next(0, run));
  plant.put<std::uint8_t>("a", 3);
  sut.begin();
  plant.put<double>("c", 1.5);
  plant.put<std::uint8_t>("a", 4);  // another writer does
  sut.clock(12345);
  sut.record_answer(-3, {});
  sut.record_answer(5, std::vector<std::uint8_t>{9, 8, 7, 6, 5, 4, 3, 2, 1});
  EXPECT_FALSE(reader.next(0, run)) << "it has not ended";
  sut.end(Plant::at(17), kFaulted);
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.module, 0U);
  EXPECT_EQ(run.flags, std::uint32_t{kFaulted});
  EXPECT_EQ(run.tail.tick, 17U);
  EXPECT_EQ(run.tail.number, 0U);
  EXPECT_EQ(run.tail.end_ns, 17'000'009);
  EXPECT_THAT(run.clock, testing::ElementsAre(12345));
  ASSERT_EQ(run.answers.size(), 2U);
  EXPECT_EQ(run.answers[0].code, -3);
  EXPECT_TRUE(run.answers[0].bytes.empty());
  EXPECT_EQ(run.answers[1].code, 5);
  EXPECT_THAT(std::vector<std::uint8_t>(run.answers[1].bytes.begin(), run.answers[1].bytes.end()),
              testing::ElementsAre(9, 8, 7, 6, 5, 4, 3, 2, 1));
  std::vector<std::tuple<EntryKind, std::uint32_t, std::vector<std::uint8_t>>> inputs;
  for (const Value& value : run.values) {
    inputs.emplace_back(value.kind, value.variable, std::vector<std::uint8_t>(value.bytes.begin(), value.bytes.end()));
  }
  EXPECT_THAT(inputs,
              testing::IsSupersetOf({std::tuple(EntryKind::Before, plant.index("a"), bytes_of<std::uint8_t>(3)),
                                     std::tuple(EntryKind::Before, plant.index("b"), bytes_of<std::uint32_t>(7)),
                                     std::tuple(EntryKind::During, plant.index("a"), bytes_of<std::uint8_t>(4)),
                                     std::tuple(EntryKind::After, plant.index("c"), bytes_of<double>(1.5))}));
  // Nothing changed: only one is recorded again, in turn.
  sut.begin();
  sut.end(Plant::at(18), 0);
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.tail.number, 1U);
  EXPECT_GT(run.tail.order, 0U);
  ASSERT_EQ(run.values.size(), 1U);
  EXPECT_EQ(run.values[0].kind, EntryKind::Again);
}

TEST(Track, The_inputs_of_a_run_are_bounded_and_one_that_is_too_long_is_named) {
  Plant plant("toldmuch", {{"a", ""}}, 16 * 1024);
  Track& sut = plant.track(0);
  Follower reader = plant.follow();
  const std::vector<std::uint8_t> large(1U << 20U, 7);
  sut.record_answer(0, large);  // no run
  sut.begin();
  sut.record_answer(1, large);
  for (int i = 0; i < 2 * kMaxAnswers; ++i) {
    sut.record_answer(i, {});
  }
  sut.end(Plant::at(1), 0);
  tape::Run run;
  ASSERT_TRUE(reader.next(0, run));
  constexpr std::uint64_t kRing = 1024;  // words, the least a track has; each input takes two of its share
  ASSERT_EQ(run.answers.size(), kRing / kAnswerShare / 2);
  EXPECT_EQ(run.answers[0].code, kTooLongToTell);
  EXPECT_TRUE(run.answers[0].bytes.empty());
  EXPECT_EQ(run.answers[1].code, 0);
}

TEST(Track, A_run_that_never_ended_is_recorded_whole_by_the_next) {
  Plant plant("unended", {{"a", ""}});
  Track& sut = plant.track(0);
  sut.begin();
  sut.end(Plant::at(0), 0);
  plant.put<std::uint8_t>("a", 9);
  sut.begin();  // thrown out: no end
  sut.begin();
  sut.end(Plant::at(2), 0);
  Follower reader = plant.follow();
  tape::Run run;
  ASSERT_TRUE(reader.next(0, run));
  ASSERT_TRUE(reader.next(0, run));
  ASSERT_FALSE(run.values.empty());
  EXPECT_EQ(run.values[0].kind, EntryKind::Before);
  EXPECT_EQ(run.values[0].bytes[0], 9);
}

TEST(Track, Polls_are_recorded_only_if_something_changed) {
  Plant plant("others", {{"a", ""}});
  Track& sut = plant.others();
  sut.record_others(Plant::at(0));
  for (std::uint64_t tick = 1; tick < 100; ++tick) {
    sut.record_others(Plant::at(tick));
  }
  plant.put<double>("d", 2.5, 80);
  sut.record_others(Plant::at(100));
  Follower reader = plant.follow();
  tape::Run run;
  ASSERT_TRUE(reader.next(1, run));
  EXPECT_EQ(run.module, kOthers);
  EXPECT_GE(run.values.size(), 4U) << "b, c, d, e and one again";
  ASSERT_TRUE(reader.next(1, run));
  EXPECT_EQ(run.tail.tick, 100U);
  EXPECT_FALSE(reader.next(1, run));
}

TEST(Track, Goes_on_where_another_process_left_it) {
  Plant plant("member", {{"ab", "c"}});
  auto first = Member::open(plant.node(), 0, plant.store());
  ASSERT_TRUE(first.ok());
  first->track().begin();
  first->track().end(Plant::at(0), 0);
  auto second = Member::open(plant.node(), 0, plant.store());
  ASSERT_TRUE(second.ok());
  second->track().begin();
  second->track().end(Plant::at(1), 0);
  Follower reader = plant.follow();
  tape::Run run;
  ASSERT_TRUE(reader.next(0, run));
  ASSERT_TRUE(reader.next(0, run));
  EXPECT_EQ(run.tail.number, 1U);
  EXPECT_EQ(reader.lost(0), 0U);
  EXPECT_EQ(Member::open(plant.node(), 7, plant.store()).error().code, Errc::NotFound);
}

// Against a model: whatever is written, a reader of the tape alone believes what is true at the end of each run.
TEST(Track, A_reader_believes_what_is_true) {
  std::mt19937 engine(11);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  for (int round = 0; round < 20; ++round) {
    Plant plant("model", {{"abd", "ce"}});
    Track& sut = plant.track(0);
    Follower reader = plant.follow();
    Believed believed;
    const auto change = [&] {
      switch (random() % 5) {
        case 0:
          plant.put<std::uint8_t>("a", static_cast<std::uint8_t>(random()));
          break;
        case 1:
          plant.put<std::uint32_t>("b", static_cast<std::uint32_t>(random()));
          break;
        case 2:
          plant.put<double>("c", static_cast<double>(random()));
          break;
        case 3:
          plant.put<double>("d", static_cast<double>(random()), 8 * (random() % 30));
          break;
        default:
          plant.put<std::uint8_t>("e", static_cast<std::uint8_t>(random()), random() % 5);
      }
    };
    for (std::uint64_t tick = 0; tick < 3000; ++tick) {
      for (auto changes = random() % 3; changes > 0; --changes) {
        change();
      }
      sut.begin();
      for (auto changes = random() % 3; changes > 0; --changes) {
        change();
      }
      sut.end(Plant::at(tick), 0);
      tape::Run run;
      ASSERT_TRUE(reader.next(0, run));
      ASSERT_EQ(run.tail.tick, tick);
      believed.take(run);
      for (const char* name : {"a", "b", "c", "d", "e"}) {
        ASSERT_EQ(believed.values[plant.index(name)], plant.bytes(name)) << name << " at " << tick;
      }
    }
  }
}

// The writer never waits: a reader that is too slow loses whole runs, knows how many, and reads nothing that was not
// written.
TEST(Track, Readers_that_are_overtaken_know_what_they_lost) {
  Plant plant("overtaken", {{"b", "d"}}, 2000);
  Track& sut = plant.track(0);
  constexpr std::uint64_t kRuns = 200'000;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t tick = 0; tick < kRuns; ++tick) {
      plant.put<std::uint32_t>("b", static_cast<std::uint32_t>(tick));
      sut.begin();
      plant.put<double>("d", static_cast<double>(tick), 8 * static_cast<std::uint32_t>(tick % 30));
      sut.end(Plant::at(tick), 0);
    }
    done = true;
  });
  Follower reader = plant.follow();
  tape::Run run;
  std::uint64_t read = 0;
  std::uint64_t last = 0;
  for (bool more = true; more;) {
    more = !done;
    while (reader.next(0, run)) {
      ASSERT_TRUE(read == 0 || run.tail.tick > last);
      last = run.tail.tick;
      ++read;
      for (const Value& value : run.values) {
        if (value.kind == EntryKind::Before) {
          ASSERT_EQ(std::vector<std::uint8_t>(value.bytes.begin(), value.bytes.end()),
                    bytes_of(static_cast<std::uint32_t>(last)));
        }
      }
    }
    std::this_thread::yield();
  }
  writer.join();
  EXPECT_EQ(last, kRuns - 1);
  EXPECT_LE(read + reader.lost(0), kRuns);
  EXPECT_GT(read, 0U);
}

}  // namespace
}  // namespace indurop::tape
