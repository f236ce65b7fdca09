// SPDX-License-Identifier: Apache-2.0
// Values followed through random plants in virtual time, compared with values that carry where they come from: never
// another run than the right one, and all of them if values change in every run.

#include "history/explain/chain_follow.h"

#include <map>
#include <string>

#include "tests/unit/chain/random_plants.h"

namespace indurop::explain {
namespace {

using config::ChainLink;
using config::Nanos;
using config::Random;
using config::Runs;

enum class Changes { Always, Seldom, Toggles, Never };

struct Version {
  std::int64_t visible = 0;
  std::int64_t release = 0;
  std::int64_t origin = 0;
  std::uint64_t value = 0;
};

const Version* newest(const std::vector<Version>& versions, std::int64_t now) {
  const Version* found = nullptr;
  for (const Version& one : versions) {
    if (one.visible <= now && (found == nullptr || one.release >= found->release)) {
      found = &one;
    }
  }
  return found;
}

std::uint64_t value_of(Changes changes, std::size_t run, Random& random) {
  switch (changes) {
    case Changes::Always:
      return 1 + run;
    case Changes::Seldom:
      return 1 + run / 7;
    case Changes::Toggles:
      return 1 + static_cast<std::uint64_t>(random.upto(0, 1));
    case Changes::Never:
      return 1;
  }
  return 0;
}

// What is to be found: by release of a last run, the release of the first one.
using Truth = std::map<std::int64_t, std::int64_t>;

struct Played {
  std::vector<ChainStage> stages;
  Truth truth;
};

Played play(const std::vector<Runs>& runs, const std::vector<std::int64_t>& phases, const std::vector<ChainLink>& links,
            Changes changes, Random& random) {
  Played played;
  std::vector<Version> versions;
  for (std::size_t i = 0; i < links.size(); ++i) {
    ChainStage stage;
    std::vector<Version> next;
    const std::int64_t phase = phases[links[i].board];
    stage.leaves = i + 1 < links.size() && links[i + 1].board != links[i].board;
    std::int64_t visible = 0;
    for (const config::Run& run : runs[links[i].board][links[i].module]) {
      const Version* const seen = i == 0 ? nullptr : newest(versions, run.start + phase);
      const std::uint64_t left = value_of(changes, stage.runs.size(), random);
      stage.runs.push_back({stage.runs.size(), run.release + phase, run.start + phase, run.end + phase,
                            seen == nullptr ? 0 : seen->value, left});
      if (i > 0 && seen == nullptr) {
        continue;
      }
      const std::int64_t origin = i == 0 ? run.release + phase : seen->origin;
      const std::int64_t delay = stage.leaves ? random.upto(100'000, 1'600'000) : 0;
      visible = std::max(visible, run.end + phase + delay);  // in order
      next.push_back({visible, run.release, origin, left});
      if (i + 1 == links.size()) {
        played.truth[run.release + phase] = origin;
      }
    }
    versions = std::move(next);
    played.stages.push_back(std::move(stage));
  }
  return played;
}

TEST(ChainFollow, Finds_the_right_run_or_none_in_random_plants) {
  std::size_t found = 0;
  std::size_t unclear = 0;
  std::size_t younger = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::mt19937(seed)};
    std::vector<std::vector<config::Timed>> plant;
    std::vector<Runs> runs;
    std::vector<std::int64_t> phases;
    const int boards = seed % 3 == 0 ? 1 : random.upto(2, 4);
    while (static_cast<int>(plant.size()) < boards) {
      auto board = config::random_board(random, random.upto(1, 8));
      if (auto done = config::run(board)) {
        plant.push_back(std::move(board));
        runs.push_back(*std::move(done));
        phases.push_back(random.upto(0, 9'999'999));
      }
    }
    const std::vector<ChainLink> links = config::random_chain(random, plant);
    if (links.empty()) {
      continue;
    }
    const auto changes = static_cast<Changes>(seed / 3 % 4);
    const Played played = play(runs, phases, links, changes, random);
    const ChainAges sut = follow_chain(played.stages);
    for (const ChainSample& sample : sut.samples) {
      ASSERT_TRUE(played.truth.contains(sample.to_ns));
      ASSERT_EQ(sample.from_ns, played.truth.at(sample.to_ns));
      ASSERT_GE(sample.age(), 0);
      younger += sample.from_ns > sample.to_ns ? 1U : 0U;
    }
    ASSERT_EQ(sut.foreign, 0U);
    ASSERT_EQ(sut.samples.size() + sut.repeated + sut.unread, played.stages.back().runs.size());
    found += sut.samples.size();
    unclear += sut.repeated;
    if (changes == Changes::Always) {
      ASSERT_EQ(sut.repeated, 0U);
      // Those of the begin are left out, when a value may be of a run that was not read.
      const bool crosses =
          std::any_of(played.stages.begin(), played.stages.end(), [](const auto& s) { return s.leaves; });
      ASSERT_TRUE(crosses || sut.samples.size() == played.truth.size());
      for (const auto& [last, first] : played.truth) {
        const bool settled = first > 10'000'000 + 10 * 21 * config::kBasic;
        const bool there = std::any_of(sut.samples.begin(), sut.samples.end(),
                                       [last = last](const ChainSample& one) { return one.to_ns == last; });
        ASSERT_TRUE(there || !settled) << last;
      }
    }
  }
  EXPECT_GT(found, 10'000U);
  EXPECT_GT(unclear, 1000U) << "the plants are too easy";
  EXPECT_GT(younger, 0U) << "no run began so late that it used what was released after it";
}

TEST(ChainFollow, A_run_that_was_not_read_claims_no_value_of_another_writer) {
  // The second of three writers' runs is missing; what it left is seen.
  const std::vector<ChainRun> writers{{0, 0, 0, 10, 0, 1}, {2, 200, 200, 210, 0, 3}};
  const std::vector<ChainRun> readers{{0, 0, 20, 30, 1, 0}, {1, 100, 120, 130, 2, 0}, {2, 200, 220, 230, 3, 0}};
  const ChainAges sut = follow_chain(std::vector<ChainStage>{{writers, false}, {readers, false}});
  ASSERT_EQ(sut.samples.size(), 2U);
  EXPECT_EQ(sut.samples[0].age(), 0);
  EXPECT_EQ(sut.samples[1].from_ns, 200);
  EXPECT_EQ(sut.foreign, 1U);
  EXPECT_EQ(sut.unread, 0U);
}

TEST(ChainFollow, A_value_of_an_unknown_writer_belongs_to_no_module) {
  const std::vector<ChainRun> writers{{0, 0, 0, 10, 0, 1}, {1, 100, 100, 110, 0, 2}};
  const std::vector<ChainRun> readers{{0, 0, 20, 30, 1, 0}, {1, 100, 120, 130, 99, 0}};
  const ChainAges sut = follow_chain(std::vector<ChainStage>{{writers, false}, {readers, false}});
  EXPECT_EQ(sut.samples.size(), 1U);
  EXPECT_EQ(sut.foreign, 1U);
}

Facts board_of(std::vector<RunFact> runs) {
  Facts facts;
  facts.basic_period_ns = 100;
  facts.modules.resize(2);
  facts.modules[0].period_ns = 100;
  facts.modules[1].period_ns = 200;
  facts.runs = std::move(runs);
  return facts;
}

TEST(Keeping, Reports_execution_times_of_modules_and_how_late_ticks_began) {
  const Keeping sut = keeping_of(board_of({{0, 0, 0, 5, 20, false},
                                           {1, 0, 0, 20, 130, false},
                                           {0, 1, 100, 103, 120, false},
                                           {0, 2, 200, 201, 210, false},
                                           {1, 2, 200, 210, 250, false}}));
  EXPECT_TRUE(sut.disturbed.empty());
  EXPECT_EQ(sut.longest_ns, (std::vector<std::int64_t>{17, 93})) << "the other one ran within it";
  EXPECT_EQ(sut.late_ns, 5);
}

TEST(Keeping, Names_overruns_and_lost_runs_and_does_not_count_them) {
  const Keeping sut = keeping_of(board_of({{0, 0, 0, 0, 150, false},
                                           {0, 2, 200, 200, 210, false},
                                           {0, 3, 300, 300, 310, false},
                                           {0, 4, 400, 400, 410, false}}));
  ASSERT_EQ(sut.disturbed.size(), 2U);
  EXPECT_EQ(sut.longest_ns[0], 10);
  EXPECT_TRUE(was_disturbed(sut, {0, 200}));
  EXPECT_FALSE(was_disturbed(sut, {300, 400}));
}

}  // namespace
}  // namespace indurop::explain
