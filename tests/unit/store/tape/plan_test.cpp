// SPDX-License-Identifier: Apache-2.0

#include "store/tape/plan.h"

#include <gmock/gmock.h>

#include <bit>
#include <numeric>
#include <random>

#include "store/tape/layout.h"

namespace indurop::tape {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<vars::DirectoryEntry> directory(const std::vector<std::uint32_t>& sizes) {
  std::vector<vars::DirectoryEntry> entries;
  for (const std::uint32_t size : sizes) {
    vars::DirectoryEntry entry{};
    entry.value_size = size;
    entries.push_back(entry);
  }
  return entries;
}

TEST(Plan, Sorts_what_is_read_from_what_is_written) {
  const std::vector<ModuleAccess> modules = {{4, 1000, {2, 0, 2, 1}, {1, 3}}};
  const TapePlan sut = plan_tape(modules, directory({4, 4, 4, 4, 8}), 1000, 10'000, 1'000'000);
  ASSERT_EQ(sut.tracks.size(), 2U);
  EXPECT_EQ(sut.tracks[0].module, 4U);
  EXPECT_THAT(sut.tracks[0].only_read, ElementsAre(0, 2));
  EXPECT_THAT(sut.tracks[0].both, ElementsAre(1));
  EXPECT_THAT(sut.tracks[0].only_written, ElementsAre(3));
  EXPECT_EQ(sut.tracks[1].module, kOthers);
  EXPECT_THAT(sut.tracks[1].only_read, ElementsAre(4)) << "no module reads or writes it";
}

TEST(Plan, Leaves_out_what_would_fill_the_tape) {
  const std::vector<ModuleAccess> modules = {{0, 1000, {0, 1}, {}}};
  const TapePlan sut = plan_tape(modules, directory({1001, 1000}), 1000, 10'000, 8000);
  EXPECT_FALSE(sut.taped[0]);
  EXPECT_TRUE(sut.taped[1]);
  EXPECT_THAT(sut.tracks[0].only_read, ElementsAre(1));
  EXPECT_THAT(plan_tape({}, {}, 1000, 1000, 1000).tracks, IsEmpty());
}

// The property: each track holds some of its longest runs, and all together no more than was allowed, if that is
// enough for the least of each.
TEST(Plan, Keeps_to_the_memory_and_gives_each_what_it_needs) {
  std::mt19937 engine(7);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint32_t> sizes(random() % 60 + 1);
    for (auto& size : sizes) {
      size = random() % 300 + 1;
    }
    std::vector<ModuleAccess> modules(random() % 20 + 1);
    for (std::uint32_t i = 0; i < modules.size(); ++i) {
      modules[i].module = i;
      modules[i].period_ns = static_cast<std::int64_t>(random() % 100 + 1) * 100'000;
      for (std::uint32_t v = 0; v < sizes.size(); ++v) {
        if (random() % 5 == 0) {
          (random() % 2 == 0 ? modules[i].reads : modules[i].writes).push_back(v);
        }
      }
    }
    constexpr std::uint64_t kBytes = 8'000'000;
    const TapePlan sut = plan_tape(modules, directory(sizes), 100'000, 2'000'000'000, kBytes);
    std::uint64_t sum = 0;
    std::uint64_t least = 0;
    for (const TrackPlan& track : sut.tracks) {
      ASSERT_TRUE(std::has_single_bit(track.words));
      std::uint64_t longest = 1 + kRunWords;
      for (const auto* list : {&track.only_read, &track.both, &track.only_written}) {
        for (const std::uint32_t v : *list) {
          longest += 1 + words_of(sizes[v]);
        }
      }
      ASSERT_GE(track.words, 4 * longest);
      sum += track.words * 8;
      least += std::bit_ceil(std::max<std::uint64_t>(1024, 16 * longest)) * 8;
    }
    ASSERT_LE(sum, std::max(kBytes, least) + least);
  }
}

TEST(Plan, Says_what_it_reaches_and_what_more_wants) {
  const std::vector<ModuleAccess> modules = {{0, 1'000'000, {0}, {1}}, {1, 10'000'000, {1}, {2}}};
  const auto variables = directory({800, 800, 800});
  const TapePlan ample = plan_tape(modules, variables, 1'000'000, 2'000'000'000, 100'000'000);
  EXPECT_GE(ample.reach_ns, 2'000'000'000);
  const TapePlan exact = plan_tape(modules, variables, 1'000'000, 2'000'000'000, ample.bytes_wanted);
  EXPECT_GE(exact.reach_ns, 2'000'000'000);
  const TapePlan little = plan_tape(modules, variables, 1'000'000, 2'000'000'000, 1'000'000);
  EXPECT_EQ(little.bytes_wanted, ample.bytes_wanted);
  EXPECT_GT(little.reach_ns, 100'000'000) << "of five megabytes one";
  EXPECT_LT(little.reach_ns, 1'000'000'000);
}

}  // namespace
}  // namespace indurop::tape
