// SPDX-License-Identifier: Apache-2.0
#include "store/tape/versions.h"

#include <gmock/gmock.h>

#include <map>
#include <random>
#include <tuple>

#include "tape_fixture.h"

namespace indurop::tape {
namespace {

using test::Plant;

TEST(Versions, Runs_carry_the_number_of_the_version_that_ran) {
  Plant plant("versions", {{"ab", "bc"}, {"c", ""}});
  Track& sut = plant.track(0);
  Follower reader = plant.follow();
  const std::uint32_t first = plant.tape().versions().add_first(0, std::string(64, 'a'), "/cell/press.so");
  const std::uint32_t second = plant.tape().versions().add(0, std::string(64, 'b'), std::string(1000, 'x'));
  sut.set_version(first);
  sut.set_other_version(second);
  std::uint64_t tick = 0;
  const auto next_flags = [&](std::uint32_t flags = 0) {
    sut.begin();
    sut.end(Plant::at(++tick), flags);
    tape::Run run;
    EXPECT_TRUE(reader.next(0, run));
    return std::tuple(version_in(run.flags), run.flags & ((1U << kVersionShift) - 1));
  };
  EXPECT_EQ(next_flags(), std::tuple(first, 0U));
  sut.note_exchange();
  EXPECT_EQ(next_flags(), std::tuple(second, std::uint32_t{kExchanged}));
  EXPECT_EQ(next_flags(kFaulted), std::tuple(second, std::uint32_t{kFaulted}));
  sut.note_exchange();
  EXPECT_EQ(next_flags(), std::tuple(first, std::uint32_t{kExchanged})) << "the other one returns";
  sut.set_version(second);
  sut.note_restart();
  EXPECT_EQ(next_flags(), std::tuple(second, std::uint32_t{kRestarted}));
  EXPECT_EQ(next_flags(), std::tuple(second, 0U));

  const auto known = reader.version(first);
  ASSERT_TRUE(known.has_value());
  EXPECT_EQ(known->digest, std::string(64, 'a'));
  EXPECT_EQ(known->file, "/cell/press.so");
  EXPECT_TRUE(known->of_start);
  EXPECT_EQ(reader.version(second)->digest, std::string(64, 'b'));
  EXPECT_EQ(reader.version(second)->file, "") << "it is longer than its place";
  EXPECT_FALSE(reader.version(second)->of_start);
  EXPECT_FALSE(reader.version(0).has_value());
  EXPECT_FALSE(reader.version(second + 1).has_value());
}

TEST(Versions, The_newest_are_known_and_those_of_the_start_always) {
  constexpr std::uint32_t kModules = 3;
  std::vector<std::pair<std::string, std::string>> modules(kModules, {"a", ""});
  Plant plant("newest", modules);
  const Follower reader = plant.follow();
  std::map<std::uint32_t, std::uint32_t> modules_of;  // by number
  for (std::uint32_t module = 0; module < kModules; ++module) {
    modules_of[plant.tape().versions().add_first(module, "", "")] = module;
  }
  EXPECT_EQ(plant.tape().versions().add_first(kModules, "", ""), 0U) << "there is no such module";
  std::mt19937 engine(7);
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < 3 * kLaterVersions; ++i) {
    const auto module = static_cast<std::uint32_t>(engine() % kModules);
    last = plant.tape().versions().add(module, "", "");
    EXPECT_TRUE(modules_of.emplace(last, module).second) << "a number is used once";
    for (const auto& [number, of] : modules_of) {
      const bool is_there = number <= kModules || number + kLaterVersions > last;
      const auto known = reader.version(number);
      ASSERT_EQ(known.has_value(), is_there) << number << " of " << last;
      EXPECT_TRUE(!known || (known->module == of && known->number == number));
    }
  }
  while (const std::uint32_t number = plant.tape().versions().add(0, "", "")) {
    last = number;
  }
  EXPECT_EQ(last, kMaxVersionNumber) << "no number is used twice";
}

}  // namespace
}  // namespace indurop::tape
