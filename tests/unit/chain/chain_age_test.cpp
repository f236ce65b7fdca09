// SPDX-License-Identifier: Apache-2.0
// What is predicted of a chain's age, compared with schedules in virtual time: never older, never newer, and on one
// board as old as predicted.

#include "config/check/chain_age.h"

#include <cstdlib>
#include <string>

#include "tests/unit/chain/random_plants.h"

namespace indurop::config {
namespace {

struct Version {
  std::int64_t visible = 0;
  std::int64_t release = 0;
  std::int64_t origin = 0;  // release of the first run it comes from
};

struct Measured {
  std::int64_t least = INT64_MAX;
  std::int64_t most = INT64_MIN;
  int younger = 0;  // runs that used what was released after them
};

// Goes through the plant with what every module wrote, link by link.
class Walk {
 public:
  Walk(const std::vector<Runs>& runs, std::vector<std::int64_t> phases, NetworkShare network, Random& random)
      : runs_(runs), phases_(std::move(phases)), network_(network), random_(random) {}

  Measured along(const std::vector<ChainLink>& links) {
    std::vector<Version> versions;
    Measured measured;
    for (std::size_t i = 0; i < links.size(); ++i) {
      std::vector<Version> next;
      std::int64_t sent = INT64_MIN / 2;
      for (const Run& run : runs_[links[i].board][links[i].module]) {
        const std::int64_t phase = phases_[links[i].board];
        const auto origin = i == 0 ? std::optional(run.release + phase) : newest(versions, run.start + phase);
        if (!origin) {
          continue;
        }
        const bool last = i + 1 == links.size();
        const bool leaves = !last && links[i + 1].board != links[i].board;
        // Boards do not end at the same time, nor begin.
        if (last && run.release > 140 * kBasic && run.release < 220 * kBasic) {
          const std::int64_t apart = run.release + phase - *origin;
          measured.younger += apart < 0 ? 1 : 0;
          measured.least = std::min(measured.least, std::max<std::int64_t>(apart, 0));
          measured.most = std::max(measured.most, std::max<std::int64_t>(apart, 0));
        }
        if (!leaves) {
          next.push_back({run.end + phase, run.release, *origin});
        } else if (run.end - sent >= links[i].every.count()) {
          sent = run.end;
          next.push_back({run.end + phase + delay(), run.release, *origin});
        }
      }
      versions = std::move(next);
    }
    return measured;
  }

 private:
  std::int64_t delay() {
    return random_.upto(static_cast<int>(network_.least.count()), static_cast<int>(network_.most.count()));
  }
  static std::optional<std::int64_t> newest(const std::vector<Version>& versions, std::int64_t now) {
    const Version* found = nullptr;
    for (const Version& one : versions) {
      if (one.visible <= now && (found == nullptr || one.release >= found->release)) {
        found = &one;
      }
    }
    return found == nullptr ? std::nullopt : std::optional(found->origin);
  }

  const std::vector<Runs>& runs_;
  std::vector<std::int64_t> phases_;
  NetworkShare network_;
  Random& random_;
};

TEST(ChainAge, Of_random_plants_is_never_above_what_is_predicted_and_on_one_board_reaches_it) {
  const char* wanted = std::getenv("INDUROP_CHAIN_PLANTS");
  const int plants = wanted == nullptr ? 100 : std::atoi(wanted);
  int single = 0;
  int crossing = 0;
  int reached = 0;
  int younger = 0;
  for (unsigned seed = 0; single + crossing < plants; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::mt19937(seed)};
    std::vector<std::vector<Timed>> plant;
    std::vector<Runs> runs;
    std::vector<std::int64_t> phases;
    const int boards = seed % 2 == 0 ? 1 : random.upto(2, 8);
    for (int i = 0; i < boards; ++i) {
      for (;;) {
        auto board = random_board(random, random.upto(1, 50 / boards));
        if (auto done = run(board)) {
          plant.push_back(std::move(board));
          runs.push_back(*std::move(done));
          break;
        }
      }
      phases.push_back(random.upto(0, 9'999'999));
    }
    const NetworkShare network{Nanos(100'000), Nanos(100'000 + random.upto(0, 1'500'000))};
    const std::vector<ChainLink> links = random_chain(random, plant);
    if (links.size() < 2) {
      continue;
    }
    const ChainAge sut = chain_age(plant, links, network);
    const Measured measured = Walk(runs, phases, network, random).along(links);
    ASSERT_LE(measured.most, sut.most.count());
    ASSERT_GE(measured.least, sut.least.count());
    ASSERT_GE(sut.least.count(), 0);
    younger += measured.younger;
    ASSERT_EQ(sut.exact, sut.crossings == 0);
    int& count = sut.exact ? single : crossing;
    ++count;
    reached += sut.exact && static_cast<double>(measured.most) >= 0.95 * static_cast<double>(sut.most.count()) ? 1 : 0;
  }
  EXPECT_GE(reached * 100, 95 * single);
  EXPECT_GT(crossing, plants / 4);
  EXPECT_GT(younger, 0);
}

TEST(ChainAge, Is_the_way_through_the_schedule) {
  const Nanos ms(kBasic);
  // Sensor before control before actuator, in one tick; backwards each costs a period.
  const std::vector<std::vector<Timed>> plant{{{ms, {}, {}, 0}, {2 * ms, {}, {}, 0}, {5 * ms, {}, {}, 0}}};
  const ChainAge down = chain_age(plant, std::vector<ChainLink>{{0, 0, {}}, {0, 1, {}}, {0, 2, {}}}, {});
  EXPECT_EQ(down.least, Nanos{});
  EXPECT_EQ(down.most, ms) << "the actuator's tick is odd every other time";
  const ChainAge up = chain_age(plant, std::vector<ChainLink>{{0, 2, {}}, {0, 0, {}}}, {});
  EXPECT_EQ(up.least, ms);
  EXPECT_EQ(up.most, 5 * ms);
}

TEST(ChainAge, Through_the_network_counts_the_senders_period_its_rate_and_the_delay) {
  const Nanos ms(kBasic);
  const std::vector<std::vector<Timed>> plant{{{ms, {}, {}, 0}}, {{ms, {}, {}, 0}}};
  const NetworkShare network{ms / 10, ms / 2};
  const ChainAge always = chain_age(plant, std::vector<ChainLink>{{0, 0, {}}, {1, 0, {}}}, network);
  EXPECT_EQ(always.least, ms / 10);
  EXPECT_EQ(always.most, ms + ms / 2);
  EXPECT_EQ(always.crossings, 1U);
  const ChainAge seldom = chain_age(plant, std::vector<ChainLink>{{0, 0, 10 * ms}, {1, 0, {}}}, network);
  EXPECT_EQ(seldom.most, 10 * ms + ms / 2);
}

}  // namespace
}  // namespace indurop::config
