// SPDX-License-Identifier: Apache-2.0
// Ten thousand variables: each is in the file with its value, and a ring that is too small for them is reported.

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include "history/recorder/recorder.h"
#include "history/recorder/run_words.h"
#include "history/recording/mcap_reader.h"
#include "store/tape/tape.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::recorder {
namespace {

constexpr std::uint32_t kMany = 10'000;

class Many : public ::testing::Test {
 protected:
  Many() : store_(vars::Store::create(node_.name(), schema()).value()) {}
  ~Many() override { std::filesystem::remove(file_); }

  static schema::Schema schema() {
    schema::Schema made;
    for (std::uint32_t i = 0; i < kMany; ++i) {
      made.variables.push_back(
          vars::test::variable("v" + std::to_string(i), vars::test::array_type(schema::Base::UInt64, 2)));
    }
    return made;
  }
  // One module writes all of them.
  void make_tape(std::uint64_t bytes) {
    tape::ModuleAccess access{0, 1'000'000, {}, {}};
    for (std::uint32_t i = 0; i < kMany; ++i) {
      access.writes.push_back(i);
    }
    const auto plan = tape::plan_tape({&access, 1}, store_.directory(), 1'000'000, 100'000'000, bytes);
    tape_ = tape::Tape::create(node_.name(), store_, plan, 1).value();
  }
  void run(std::uint64_t tick) {
    tape::Track& track = *tape_->of(0);
    track.begin();
    for (std::uint32_t i = 0; i < kMany; ++i) {
      const std::string& name = store_.schema().variables[store_.directory()[i].schema_index].name;
      const std::uint64_t value[2] = {tick, std::stoul(name.substr(1))};
      (void)store_.write(store_.directory()[i], 0, {reinterpret_cast<const std::uint8_t*>(value), sizeof value});
    }
    const auto ns = static_cast<std::int64_t>(tick) * 1'000'000;
    track.end({0, 0, tick, ns, ns + 5, ns + 9}, 0);
  }
  Recorder record() {
    About about;
    about.node = node_.name();
    about.basic_period_ns = 1'000'000;
    about.modules = {"writer"};
    return Recorder::create(file_, about, store_, tape::Follower::open(node_.name(), true).value(), {}).value();
  }

  vars::test::TestNode node_{"manyvars"};
  vars::Store store_;
  std::unique_ptr<tape::Tape> tape_;
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("indurop-many-" + std::to_string(::getpid()) + ".mcap");
};

TEST_F(Many, Are_all_in_the_file) {
  make_tape(8'000'000);
  Recorder sut = record();
  for (std::uint64_t tick = 0; tick < 20; ++tick) {
    run(tick);
    ASSERT_TRUE(sut.take().ok());
  }
  ASSERT_TRUE(sut.close().ok());
  EXPECT_TRUE(sut.counts().lost.empty());
  auto reader = recording::McapReader::open(file_);
  ASSERT_TRUE(reader.ok());
  std::map<std::string, std::uint64_t> last;
  for (auto next = reader->next(); next && *next; next = reader->next()) {
    const recording::McapMessage& one = **next;
    const std::string& topic = reader->contents().channels.at(one.channel).topic;
    if (topic.starts_with("v") && from_sequence(one.sequence).kind == tape::EntryKind::After) {
      std::uint64_t value[2] = {};
      ASSERT_EQ(one.data.view.size(), 4 + sizeof value);
      std::memcpy(value, one.data.view.data() + 4, sizeof value);
      ASSERT_EQ(topic, "v" + std::to_string(value[1]));
      ASSERT_GE(value[0], last[topic]);
      last[topic] = value[0];
    }
  }
  ASSERT_EQ(last.size(), kMany);
  for (const auto& [topic, tick] : last) {
    ASSERT_EQ(tick, 19U) << topic;
  }
}

TEST_F(Many, Of_a_ring_too_small_for_a_slow_recorder_are_counted) {
  make_tape(1'000'000);  // holds what a module needs at least, a few runs
  Recorder sut = record();
  run(0);
  ASSERT_TRUE(sut.take().ok());
  for (std::uint64_t tick = 1; tick <= 100; ++tick) {
    run(tick);
  }
  ASSERT_TRUE(sut.take().ok());
  ASSERT_TRUE(sut.close().ok());
  ASSERT_TRUE(sut.counts().lost.contains(0));
  EXPECT_EQ(sut.counts().runs + sut.counts().lost.at(0), 101U);
  EXPECT_GE(sut.counts().runs, 3U) << "the newest are there";
}

}  // namespace
}  // namespace indurop::recorder
