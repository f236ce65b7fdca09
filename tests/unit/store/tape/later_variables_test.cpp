// SPDX-License-Identifier: Apache-2.0
// Variables that appear while the node runs: they are on the track of a module from the exchange on that brings them.

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <utility>

#include "tape_fixture.h"

namespace indurop::tape {
namespace {

using test::Plant;
using vars::test::bytes_of;

class LaterVariables : public testing::Test {
 protected:
  // The store gets a variable of this name; returns its index.
  std::uint32_t appear(const schema::Variable& one) {
    const std::vector<schema::Variable> all{one};
    EXPECT_TRUE(plant_.store().reserve(all).ok());
    auto next = plant_.store().prepare(all);
    EXPECT_TRUE(next.ok());
    plant_.store().announce(std::move(next).value());
    return plant_.index(one.name);
  }
  tape::Run run_once(Follower& reader) {
    plant_.track(0).begin();
    if (written_) {
      written_();
    }
    plant_.track(0).end(Plant::at(++tick_), 0);
    tape::Run run;
    EXPECT_TRUE(reader.next(0, run));
    return run;
  }
  static std::map<std::pair<EntryKind, std::uint32_t>, std::vector<std::uint8_t>> values(const tape::Run& run) {
    std::map<std::pair<EntryKind, std::uint32_t>, std::vector<std::uint8_t>> found;
    for (const Value& value : run.values) {
      found[{value.kind, value.variable}] = {value.bytes.begin(), value.bytes.end()};
    }
    return found;
  }
  Plant plant_{"later", {{"ab", "bc"}}};
  std::function<void()> written_;
  std::uint64_t tick_ = 0;
};

TEST_F(LaterVariables, Are_recorded_from_the_exchange_on_that_brings_them) {
  Follower early = plant_.follow();  // opened before they appear
  early.show_later_variables();
  Follower old_kind = plant_.follow();
  (void)run_once(early);
  const std::uint32_t f = appear(vars::test::variable("f", vars::test::scalar_type(schema::Base::UInt8)));
  const std::uint32_t g = appear(vars::test::variable("g", vars::test::array_type(schema::Base::Double, 3)));
  EXPECT_THAT(plant_.tape().offer(
                  0, std::vector<VariableUse>{{plant_.index("a"), true, false}, {f, true, false}, {g, false, true}}),
              testing::IsEmpty());
  plant_.put<std::uint8_t>("f", 9);
  auto before = values(run_once(early));
  EXPECT_FALSE(before.contains({EntryKind::Before, f})) << "the version that uses it does not run yet";
  plant_.track(0).note_exchange();
  written_ = [this] { plant_.put<double>("g", 2.5, 8); };
  auto first = values(run_once(early));
  EXPECT_EQ((first[{EntryKind::Before, f}]), bytes_of<std::uint8_t>(9));
  EXPECT_EQ((first[{EntryKind::After, g}]), plant_.bytes("g"));
  EXPECT_FALSE(first.contains({EntryKind::Before, g}));
  EXPECT_EQ(early.variables().size(), g + 1U);
  EXPECT_EQ(early.variables()[g].size, 24U);
  EXPECT_TRUE(early.first_value(g).empty());
  written_ = nullptr;
  auto second = values(run_once(early));
  EXPECT_EQ(second.size(), 1U) << "nothing has changed, one is recorded again";
  plant_.track(0).note_exchange();  // the previous version returns
  plant_.put<std::uint8_t>("f", 3);
  EXPECT_EQ((values(run_once(early))[{EntryKind::Before, f}]), bytes_of<std::uint8_t>(3)) << "they stay on the track";

  Follower late = plant_.follow();
  late.show_later_variables();
  tape::Run run;
  ASSERT_TRUE(late.next(0, run));
  EXPECT_EQ(late.variables().size(), g + 1U);
  int runs = 0;
  while (old_kind.next(0, run)) {
    ++runs;
    for (const Value& value : run.values) {
      EXPECT_LT(value.variable, 5U) << "a reader that does not expect them gets none";
    }
  }
  EXPECT_EQ(runs, 5);
  EXPECT_EQ(old_kind.variables().size(), 5U);
}

TEST_F(LaterVariables, That_are_too_large_for_the_track_are_named) {
  const std::uint32_t f = appear(vars::test::variable("f", vars::test::array_type(schema::Base::Double, 4000)));
  EXPECT_THAT(plant_.tape().offer(0, std::vector<VariableUse>{{f, true, true}}), testing::ElementsAre(f));
}

// What a reader knows of each variable at the start and the end of a run is what the store held then, however the
// variables came to the track.
// Long: one loop of random steps, and the oracle next to each.
TEST_F(LaterVariables, Random_growth_is_recorded_as_the_store_holds_it) {
  std::mt19937 engine(11);
  const auto random = [&engine](std::uint32_t below) { return static_cast<std::uint32_t>(engine() % below); };
  Follower reader = plant_.follow();
  reader.show_later_variables();
  std::map<std::uint32_t, VariableUse> uses;  // of the later ones, on the track
  std::map<std::uint32_t, VariableUse> offered;
  std::vector<std::string> names;
  std::map<std::uint32_t, std::vector<std::uint8_t>> known;
  for (int round = 0; round < 2000; ++round) {
    if (names.size() < 20 && random(50) == 0) {
      names.push_back("later" + std::to_string(names.size()));
      constexpr schema::Base kBases[] = {schema::Base::Bool, schema::Base::Int64, schema::Base::Float,
                                         schema::Base::Int16};
      appear(vars::test::variable(names.back(), random(2) == 0
                                                    ? vars::test::scalar_type(kBases[random(4)])
                                                    : vars::test::array_type(schema::Base::UInt8, 1 + random(40))));
    }
    if (!names.empty() && random(20) == 0) {
      offered = uses;
      std::vector<VariableUse> more;
      for (const std::string& name : names) {
        if (const std::uint32_t how = random(4); how != 0) {
          more.push_back({plant_.index(name), (how & 1U) != 0, (how & 2U) != 0});
          VariableUse& use = offered[more.back().variable];
          use = {more.back().variable, use.reads || more.back().reads, use.writes || more.back().writes};
        }
      }
      EXPECT_THAT(plant_.tape().offer(0, more), testing::IsEmpty());
      if (random(3) != 0) {
        plant_.track(0).note_exchange();
        uses = offered;
      }
    }
    const auto change_some = [&] {
      for (const std::string& name : names) {
        if (random(3) == 0) {
          const vars::DirectoryEntry& entry = plant_.store().directory()[plant_.index(name)];
          std::vector<std::uint8_t> bytes(entry.value_size);
          std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random(2)); });
          ASSERT_TRUE(plant_.store().write(entry, 0, bytes).ok());
        }
      }
    };
    change_some();
    std::map<std::uint32_t, std::vector<std::uint8_t>> at_start;
    for (const auto& [variable, use] : uses) {
      at_start[variable] =
          plant_.bytes(plant_.store().schema().variables[plant_.store().directory()[variable].schema_index].name);
    }
    written_ = change_some;
    const tape::Run run = run_once(reader);
    for (const Value& value : run.values) {
      if (value.kind == EntryKind::Before) {
        known[value.variable].assign(value.bytes.begin(), value.bytes.end());
      }
    }
    for (const auto& [variable, use] : uses) {
      if (use.reads) {
        ASSERT_EQ(known[variable], at_start[variable]) << round << " " << variable;
      }
    }
    for (const Value& value : run.values) {
      known[value.variable].assign(value.bytes.begin(), value.bytes.end());
    }
    for (const auto& [variable, use] : uses) {
      if (use.writes) {
        const auto& name = plant_.store().schema().variables[plant_.store().directory()[variable].schema_index].name;
        ASSERT_EQ(known[variable], plant_.bytes(name)) << round << " " << name;
      }
    }
  }
  EXPECT_EQ(names.size(), 20U);
}

}  // namespace
}  // namespace indurop::tape
