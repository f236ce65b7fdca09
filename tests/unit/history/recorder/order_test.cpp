// SPDX-License-Identifier: Apache-2.0
// In virtual time, all runs of a tick have one time: what came first is known from the order in the file only.

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <thread>

#include "history/recorder/recorder.h"
#include "history/recorder/run_words.h"
#include "history/recording/mcap_reader.h"
#include "tests/unit/store/tape/tape_fixture.h"

namespace indurop::recorder {
namespace {

// Module 0 reads `a` and writes `b`; module 1, which runs before it, reads `b` and writes `a`: each a number per tick.
class Order : public ::testing::Test {
 protected:
  ~Order() override { std::filesystem::remove(file_); }

  static tape::RunTail tail(std::uint64_t tick) {
    const auto ns = static_cast<std::int64_t>(tick) * 1'000'000;
    return {0, 0, tick, ns, ns, ns};
  }
  void tick(std::uint64_t tick) {
    plant_.track(1).begin();
    plant_.put("a", static_cast<std::uint8_t>(tick));
    plant_.track(1).end(tail(tick), 0);
    plant_.track(0).begin();
    plant_.put("b", static_cast<std::uint32_t>(tick));
    plant_.track(0).end(tail(tick), 0);
  }
  Recorder record() {
    About about;
    about.node = plant_.node();
    about.basic_period_ns = 1'000'000;
    about.modules = {"writer", "reader"};
    return Recorder::create(file_, about, plant_.store(), plant_.follow(), {}).value();
  }
  // Every run, and the last value of `b` at each time, in the order of the file.
  void check(std::uint64_t ticks) {
    auto reader = recording::McapReader::open(file_);
    ASSERT_TRUE(reader.ok());
    std::uint64_t runs = 0;
    std::map<std::uint64_t, std::uint32_t> values;
    for (auto next = reader->next(); next && *next; next = reader->next()) {
      const recording::McapMessage& one = **next;
      const std::string& topic = reader->contents().channels.at(one.channel).topic;
      if (topic == kRunsTopic) {
        const auto run = run_from_cdr(one.data.view);
        ASSERT_TRUE(run.ok());
        ASSERT_EQ(run->tail.order, runs++);
      } else if (topic == "b" && from_sequence(one.sequence).kind != tape::EntryKind::Run) {
        ASSERT_EQ(one.data.view.size(), 8U);
        std::memcpy(&values[one.log_time_ns], one.data.view.data() + 4, sizeof(std::uint32_t));
      }
    }
    EXPECT_EQ(runs, 2 * ticks);
    ASSERT_EQ(values.size(), ticks);
    for (const auto& [time, value] : values) {
      EXPECT_EQ(value, time / 1'000'000) << "the reader had the value of the tick before";
    }
  }

  tape::test::Plant plant_{"order", {{"a", "b"}, {"b", "a"}}};
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("indurop-order-" + std::to_string(::getpid()) + ".mcap");
};

TEST_F(Order, Of_runs_is_kept_however_many_are_taken_at_once) {
  constexpr std::uint64_t kTicks = 500;
  std::mt19937 random(1);
  Recorder sut = record();
  for (std::uint64_t i = 1; i <= kTicks; ++i) {
    tick(i);
    if (random() % 4 == 0) {
      const bool all = random() % 2 == 0;
      ASSERT_TRUE((all ? sut.take() : sut.take(static_cast<std::int64_t>(i - random() % 3) * 1'000'000)).ok());
    }
  }
  ASSERT_TRUE(sut.take().ok());
  ASSERT_TRUE(sut.close().ok());
  check(kTicks);
}

TEST_F(Order, Of_runs_is_kept_while_they_end) {
  constexpr std::uint64_t kTicks = 2000;
  Recorder sut = record();
  std::atomic<std::uint64_t> ended{0};
  std::thread node([&] {
    for (std::uint64_t i = 1; i <= kTicks; ++i) {
      tick(i);
      ended = i;
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
  });
  while (ended < kTicks) {
    EXPECT_TRUE(sut.take().ok());
  }
  node.join();
  ASSERT_TRUE(sut.take().ok());
  ASSERT_TRUE(sut.close().ok());
  EXPECT_TRUE(sut.counts().lost.empty());
  check(kTicks);
}

}  // namespace
}  // namespace indurop::recorder
