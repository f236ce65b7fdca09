// SPDX-License-Identifier: Apache-2.0
// Facts of a recording that the test wrote: when its values changed.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "history/explain/facts_json.h"
#include "history/explain/questions.h"
#include "history/recorder/recorder.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_writer.h"
#include "history/recording/omg_idl.h"
#include "tests/unit/core/schema/types.h"
#include "tools/cli/explain/gather.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kOffset = 1'800'000'000'000'000'000;  // of the recording's times
constexpr std::uint64_t kTicks = 20;

class GatherRecorded : public ::testing::Test {
 protected:
  GatherRecorded() { std::filesystem::create_directories(folder_); }
  ~GatherRecorded() override { std::filesystem::remove_all(folder_); }

  // Module press runs each millisecond and writes cell::heat. `measured_ns`: the difference of the clocks that the
  // facts at the end of the recording have.
  void write(std::int64_t measured_ns) const {
    auto to = recording::McapWriter::create(path_, {});
    ASSERT_TRUE(to.ok());
    ASSERT_TRUE(to->metadata(recorder::kNodeMetadata, {{"node", "cell"},
                                                       {"basic_period_ns", std::to_string(kMs)},
                                                       {"real_minus_node_ns", std::to_string(kOffset)}})
                    .ok());
    const auto run_schema = to->add_schema(recorder::kRunSchema, "omgidl", recorder::kRunIdl);
    const auto runs = to->add_channel(*run_schema, std::string(recorder::kRunsTopic), "cdr", {{"0", "press"}});
    const schema::Type number = schema::number(schema::Base::UInt64);
    const recording::OmgIdl idl = recording::omg_idl(number);
    const auto heat = to->add_channel(*to->add_schema(idl.name, "omgidl", idl.text), "cell::heat", "cdr", {});
    const std::uint32_t after = recorder::to_sequence({0, tape::EntryKind::After});
    std::vector<std::uint8_t> cdr;
    for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
      recorder::RunWords run;
      run.tail.number = tick;
      run.tail.tick = tick;
      run.tail.release_ns = static_cast<std::int64_t>(tick + 1) * kMs;
      run.tail.start_ns = run.tail.release_ns + 1000;
      run.tail.end_ns = run.tail.release_ns + 3000;
      const auto time = static_cast<std::uint64_t>(kOffset + run.tail.end_ns);
      std::vector<std::uint8_t> bytes(sizeof tick, static_cast<std::uint8_t>(tick));
      ASSERT_TRUE(recording::to_cdr(number, bytes, cdr).ok());
      ASSERT_TRUE(to->write(*heat, time, time, after, cdr).ok());
      recorder::to_cdr(run, cdr);
      ASSERT_TRUE(to->write(*runs, time, time, 0, cdr).ok());
    }
    explain::Facts facts;
    facts.node = "cell";
    facts.basic_period_ns = kMs;
    facts.epoch_ns = kMs;
    facts.tick = kTicks;
    facts.now_ns = static_cast<std::int64_t>(kTicks + 1) * kMs;
    facts.wall_minus_node_ns = measured_ns;
    explain::ModuleFact press;
    press.name = "press";
    press.operation = "periodic";
    press.period_ns = kMs;
    facts.modules.push_back(press);
    const std::string text = explain::facts_text(facts);
    ASSERT_TRUE(to->attach({0, 0, std::string(explain::kFactsFile), "application/json"},
                           {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()})
                    .ok());
    ASSERT_TRUE(to->close().ok());
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("gather_recorded_" + std::to_string(::getpid()));
  const std::filesystem::path path_ = folder_ / "run.mcap";
};

// The difference between the clocks is measured at the begin of a recording and again for its facts: a process that is
// preempted in between, and a clock that is adjusted meanwhile, make the second one another.
TEST_F(GatherRecorded, Takes_the_times_of_values_as_the_file_has_them) {
  write(kOffset + 3 * kMs);
  const auto all = facts_recorded(path_, "cell::heat");
  ASSERT_TRUE(all.ok()) << all.error().text;
  ASSERT_EQ(all->size(), 1U);
  explain::Facts facts = all->front();
  ASSERT_EQ(facts.changes.size(), kTicks);
  ASSERT_EQ(facts.runs.size(), kTicks);
  for (std::size_t i = 0; i < kTicks; ++i) {
    EXPECT_EQ(facts.changes[i].tick, i);
    EXPECT_EQ(facts.changes[i].time_ns, facts.runs[i].end_ns);
  }
  EXPECT_EQ(facts.wall_minus_node_ns, kOffset);

  explain::VariableFact heat;
  heat.name = "cell::heat";
  heat.writers = {"press"};
  facts.variables.push_back(heat);
  const auto answer = explain::why_old({&facts, 1}, 0, "cell::heat", facts.release_of(facts.tick));
  EXPECT_EQ(answer.text, "press changed cell::heat in its last run");
}

}  // namespace
}  // namespace indurop::tools
