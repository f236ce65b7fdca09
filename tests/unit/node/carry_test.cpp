// SPDX-License-Identifier: Apache-2.0
// What goes from one version of a module to the next, and what is said about it.

#include "node/exchange/carry.h"

#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace indurop::node {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A version that keeps variables in one block of memory.
class Kept {
 public:
  template <class T>
  T& add(const std::string& name, const std::string& type, std::size_t count = 1) {
    names_.push_back({name, type});
    used_ = (used_ + alignof(T) - 1) / alignof(T) * alignof(T);
    auto* const place = reinterpret_cast<T*>(bytes_.data() + used_);
    used_ += count * sizeof(T);
    StateItem item;
    item.address = place;
    item.size = count * sizeof(T);
    items_.push_back(item);
    return *place;
  }
  void skip(std::size_t bytes) { used_ += bytes; }
  ModuleMemory memory(const char* missing = nullptr) {
    for (std::size_t i = 0; i < items_.size(); ++i) {
      items_[i].name = names_[i][0].data();
      items_[i].name_length = static_cast<std::uint32_t>(names_[i][0].size());
      items_[i].type = names_[i][1].data();
      items_[i].type_length = static_cast<std::uint32_t>(names_[i][1].size());
    }
    StateDescriptor declared;
    declared.items = items_.data();
    declared.item_count = static_cast<std::uint32_t>(items_.size());
    declared.missing = missing;
    return ModuleMemory(declared);
  }

 private:
  alignas(16) std::array<std::byte, 4096> bytes_{};
  std::size_t used_ = 0;
  std::vector<std::array<std::string, 2>> names_;
  std::vector<StateItem> items_;
};

void follow(const Carry& carry) {
  for (const auto& pair : carry.pairs) {
    std::memcpy(pair.new_place, pair.old_place, pair.bytes);
  }
}

TEST(CarryPlan, Variables_of_the_same_name_and_type_are_carried_in_any_order) {
  Kept before;
  before.add<int>("a", "int") = 1;
  before.add<double>("b", "double") = 2.5;
  before.add<int>("gone", "int") = 3;
  Kept after;
  auto& b = after.add<double>("b", "double");
  auto& added = after.add<int>("added", "int");
  auto& a = after.add<int>("a", "int");
  const Carry sut = plan_carry(before.memory(), after.memory());
  EXPECT_THAT(sut.plan.kept, ElementsAre("b", "a"));
  EXPECT_THAT(sut.plan.added, ElementsAre("added"));
  EXPECT_THAT(sut.plan.removed, ElementsAre("gone"));
  EXPECT_FALSE(sut.loses);
  EXPECT_FALSE(sut.between_runs);
  follow(sut);
  EXPECT_EQ(a, 1);
  EXPECT_EQ(b, 2.5);
  EXPECT_EQ(added, 0);
}

TEST(CarryPlan, Adjacent_variables_are_copied_at_once) {
  Kept before;
  Kept after;
  for (const char* name : {"a", "b", "c"}) {
    before.add<std::int64_t>(name, "long");
    after.add<std::int64_t>(name, "long");
  }
  after.skip(64);
  before.add<std::int64_t>("d", "long");
  after.add<std::int64_t>("d", "long");
  const Carry sut = plan_carry(before.memory(), after.memory());
  ASSERT_EQ(sut.pairs.size(), 2U);
  EXPECT_EQ(sut.pairs[0].bytes, 24U);
  EXPECT_EQ(sut.plan.bytes, 32U);
}

TEST(CarryPlan, An_array_may_grow_and_nothing_else_may_change_its_type) {
  struct Case {
    const char* from;
    std::size_t from_count;
    const char* to;
    std::size_t to_count;
    bool grows;
  };
  for (const Case& one : {Case{"int [4]", 4, "int [6]", 6, true}, Case{"int [6]", 6, "int [4]", 4, false},
                          Case{"int [4]", 4, "long [6]", 12, false}, Case{"int [2][2]", 4, "int [2][3]", 6, false},
                          Case{"int", 1, "long", 2, false}, Case{"int", 1, "unsigned int", 1, false},
                          Case{"ARRAY[1..4] OF INT", 4, "ARRAY[1..6] OF INT", 6, true},
                          Case{"ARRAY[-2..1] OF P #0a", 4, "ARRAY[-2..3] OF P #0a", 6, true},
                          Case{"ARRAY[1..4] OF P #0a", 4, "ARRAY[1..6] OF P #0b", 6, false},
                          Case{"ARRAY[1..4] OF INT", 4, "ARRAY[0..5] OF INT", 6, false},
                          Case{"ARRAY[1..6] OF INT", 6, "ARRAY[1..4] OF INT", 4, false},
                          Case{"ARRAY[1..2,1..2] OF INT", 4, "ARRAY[1..2,1..3] OF INT", 6, false},
                          Case{"ARRAY[1..4 OF INT", 4, "ARRAY[1..6 OF INT", 6, false},
                          Case{"int [4x]", 4, "int [6]", 6, false}, Case{"[4]", 4, "[6]", 4, false}}) {
    Kept before;
    int* const first = &before.add<int>("a", one.from, one.from_count);
    first[one.from_count - 1] = 7;
    Kept after;
    const int* const now = &after.add<int>("a", one.to, one.to_count);
    const Carry sut = plan_carry(before.memory(), after.memory());
    EXPECT_EQ(sut.loses, !one.grows) << one.from << " " << one.to;
    EXPECT_THAT(one.grows ? sut.plan.grown : sut.plan.changed, ElementsAre("a")) << one.from << " " << one.to;
    follow(sut);
    EXPECT_EQ(now[one.from_count - 1], one.grows ? 7 : 0) << one.from << " " << one.to;
  }
}

// The power flow of a ladder, which has more points when there is one more rung, or fewer.
TEST(CarryPlan, What_is_only_shown_is_carried_where_it_can_be_and_never_lost) {
  Kept before;
  before.add<int>("a", "int") = 1;
  before.add<bool>("_flow", "shown: ARRAY[0..2] OF BOOL", 3) = true;
  Kept same;
  same.add<int>("a", "int");
  const bool& flow = same.add<bool>("_flow", "shown: ARRAY[0..2] OF BOOL", 3);
  const Carry carried = plan_carry(before.memory(), same.memory());
  follow(carried);
  EXPECT_TRUE(flow);
  Kept shorter;
  const int& a = shorter.add<int>("a", "int");
  shorter.add<bool>("_flow", "shown: ARRAY[0..1] OF BOOL", 2);
  const Carry sut = plan_carry(before.memory(), shorter.memory());
  follow(sut);
  EXPECT_EQ(a, 1);
  for (const Carry* one : {&carried, &sut}) {
    EXPECT_THAT(one->plan.kept, ElementsAre("a"));
    EXPECT_THAT(one->plan.changed, IsEmpty());
    EXPECT_FALSE(one->loses);
  }
  EXPECT_THAT(plan_carry(Kept().memory(), shorter.memory()).plan.added, IsEmpty());
}

TEST(CarryPlan, What_cannot_be_carried_is_said) {
  Kept kept;
  kept.add<int>("a", "int");
  Kept nothing;
  const ModuleMemory undeclared;
  EXPECT_THAT(plan_carry(undeclared, kept.memory()).plan.why_not, HasSubstr("the running version does not declare"));
  EXPECT_THAT(plan_carry(kept.memory(), undeclared).plan.why_not, HasSubstr("the new version does not declare"));
  EXPECT_THAT(plan_carry(kept.memory("P1.p (it leads elsewhere)"), kept.memory()).plan.why_not, HasSubstr("P1.p"));
  EXPECT_THAT(plan_carry(kept.memory(), kept.memory("P1.p")).plan.why_not, HasSubstr("the new version keeps what"));
  EXPECT_TRUE(plan_carry(undeclared, kept.memory()).loses);
  EXPECT_FALSE(plan_carry(nothing.memory(), kept.memory()).loses) << "it keeps nothing that could be lost";
  const Carry to_nothing = plan_carry(kept.memory(), nothing.memory());
  EXPECT_FALSE(to_nothing.loses);
  EXPECT_THAT(to_nothing.plan.removed, ElementsAre("a"));
  EXPECT_THAT(to_nothing.pairs, IsEmpty());
}

TEST(CarryPlan, A_tick_copies_a_hundredth_of_the_period_at_most) {
  EXPECT_EQ(most_in_tick(100'000), 5000U);
  EXPECT_EQ(most_in_tick(1'000'000), 50'000U);
  EXPECT_EQ(most_in_tick(10'000'000), kMostInTick);
  EXPECT_EQ(most_in_tick(0), 5000U);
  Kept before;
  before.add<int>("a", "int");
  Kept after;
  after.add<int>("a", "int");
  EXPECT_FALSE(plan_carry(before.memory(), after.memory(), 4).between_runs);
  EXPECT_TRUE(plan_carry(before.memory(), after.memory(), 3).between_runs);
}

TEST(CarryPlan, What_is_large_or_copied_by_functions_is_copied_between_two_runs) {
  std::vector<std::byte> much(kMostInTick + 1);
  StateItem item;
  item.name = item.type = "m";
  item.name_length = item.type_length = 1;
  item.address = much.data();
  item.size = much.size();
  StateDescriptor large;
  large.items = &item;
  large.item_count = 1;
  EXPECT_TRUE(plan_carry(ModuleMemory(large), ModuleMemory(large)).between_runs);
  StateDescriptor functions;
  functions.most = 8;
  functions.save = [](void*, std::size_t) -> std::size_t { return 8; };
  functions.restore = [](const void*, std::size_t) { return true; };
  const Carry sut = plan_carry(ModuleMemory(functions), ModuleMemory(functions));
  EXPECT_TRUE(sut.between_runs);
  EXPECT_TRUE(sut.plan.with_state);
  EXPECT_THAT(plan_carry(ModuleMemory(large), ModuleMemory(functions)).plan.why_not, HasSubstr("INDUROP_STATE_BY"));
}

TEST(CarryOfProcesses, Is_planned_by_the_forms_of_their_keyframes) {
  const Carry carry = plan_carry("steps\tint\t4\nramp\tint [2]\t8\nspeed\tfloat\t4\nold\tbool\t1\n",
                                 "ramp\tint [4]\t16\nsteps\tint\t4\nspeed\tdouble\t8\nheat\tdouble\t8\n");
  EXPECT_TRUE(carry.plan.with_state);
  EXPECT_THAT(carry.plan.kept, ElementsAre("steps"));
  EXPECT_THAT(carry.plan.grown, ElementsAre("ramp"));
  EXPECT_THAT(carry.plan.changed, ElementsAre("speed"));
  EXPECT_THAT(carry.plan.added, ElementsAre("heat"));
  EXPECT_THAT(carry.plan.removed, ElementsAre("old"));
  EXPECT_EQ(carry.plan.bytes, 12U);
  EXPECT_TRUE(carry.loses) << "speed";
  EXPECT_THAT(carry.pairs, IsEmpty());
}

TEST(CarryOfProcesses, Loses_what_one_of_them_does_not_declare) {
  const std::string form = "steps\tint\t4\n";
  EXPECT_THAT(plan_carry(std::nullopt, form).plan.why_not, HasSubstr("the running version does not declare"));
  EXPECT_TRUE(plan_carry(std::nullopt, form).loses);
  EXPECT_THAT(plan_carry(form, std::nullopt).plan.why_not, HasSubstr("the new version does not declare"));
  EXPECT_THAT(plan_carry(form, "\tbytes of its save()\t64\n").plan.why_not, HasSubstr("by functions"));
  EXPECT_FALSE(plan_carry("", form).loses) << "the one that runs keeps nothing";
  EXPECT_FALSE(plan_carry(form, "").loses) << "the new one needs nothing";
  EXPECT_FALSE(plan_carry(form, form).loses);
}

}  // namespace
}  // namespace indurop::node
