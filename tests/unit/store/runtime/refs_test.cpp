// SPDX-License-Identifier: Apache-2.0
// Where the variables of a generated header live: private memory, the node's store, and private memory again.

#include <gtest/gtest.h>
#include <indurop/indurop.h>
#include <indurop/plc/program.h>

#include <cstdlib>
#include <sstream>

#include <indurop/generated.h>
#include "hosted.h"

namespace {

using namespace knu::Robot;
using indurop::testing::Hosted;
using indurop::testing::TestNode;

template <class Variable>
const indurop::abi::Ref& row_of(const Variable& /*shape*/) {
  return Variable::tag_type::ref();
}

// Constructed before main: the variables must be there already.
struct EarlyUser {
  EarlyUser() : seen(tick) {
    joints[9].z = 3.5;
    stored = joints[9].z;
  }
  std::uint32_t seen;
  double stored = 0;
};
EarlyUser early_user;

TEST(Refs, Are_bound_before_static_objects_are_constructed) {
  EXPECT_EQ(early_user.seen, 7U);
  EXPECT_EQ(early_user.stored, 3.5);
}

TEST(Refs, Move_to_the_store_and_back) {
  TestNode node;
  tick = 1;
  {
    const Hosted hosted(node);
    EXPECT_TRUE(hosted.problems.empty());
    EXPECT_EQ(tick, 7U) << "the store has its own initial value";
    tick = 42;
    joints[2] = {1, 2, 3};
    const auto* entry = node.store().find(indurop::abi::fnv1a64("knu::Robot::tick", 16));
    ASSERT_NE(entry, nullptr);
    std::uint32_t stored = 0;
    ASSERT_TRUE(node.store().read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&stored), 4}));
    EXPECT_EQ(stored, 42U);
  }
  EXPECT_EQ(tick, 1U);
  EXPECT_EQ(joints[2].x, 0.0);
}

// A version of a module that does not run sees the present values and changes nothing.
TEST(Refs, Of_a_file_that_is_bound_apart_are_copies) {
  TestNode node;
  const Hosted hosted(node);
  const void* const inside = &row_of(tick);
  const auto* entry = node.store().find(indurop::abi::fnv1a64("knu::Robot::tick", 16));
  const auto stored = [&] {
    std::uint32_t value = 0;
    EXPECT_TRUE(node.store().read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&value), 4}));
    return value;
  };
  tick = 42;
  joints[2] = {1, 2, 3};
  const std::uint32_t bindings = indurop_bindings();
  indurop::runtime::bind_apart(inside);
  EXPECT_EQ(tick, 42U);
  EXPECT_EQ(joints[2].y, 2.0);
  tick = 1000;
  joints[2].y = -1;
  EXPECT_EQ(tick, 1000U);
  EXPECT_EQ(stored(), 42U);
  indurop::runtime::bind_back(inside);
  EXPECT_EQ(tick, 42U);
  EXPECT_EQ(joints[2].y, 2.0);
  tick = 43;
  EXPECT_EQ(stored(), 43U);
  indurop::runtime::bind_apart(inside);
  EXPECT_EQ(tick, 43U) << "the copies are new each time";
  indurop::runtime::bind_back(inside);
  EXPECT_EQ(indurop_bindings(), bindings) << "others need not look up their addresses";
}

TEST(Refs, Of_another_type_stay_private_and_are_named) {
  auto schema = indurop::testing::sample_schema();
  auto& changed = schema.variables[1];
  ASSERT_EQ(changed.name, "knu::Robot::joints");
  changed.type.dims = {12};
  changed.type_hash = hash_of(changed.type);
  schema.variables.pop_back();  // ready
  TestNode node({{"m", {}, 0, {}, ""}}, schema);
  const Hosted hosted(node);
  ASSERT_EQ(hosted.problems.size(), 2U);
  EXPECT_NE(hosted.problems[0].find("variable knu::Robot::joints: this program was built with"), std::string::npos);
  EXPECT_NE(hosted.problems[0].find("node '" + node.name() + "' has knu::Robot::joints_t[12] (288 bytes)"),
            std::string::npos)
      << hosted.problems[0];
  EXPECT_NE(hosted.problems[0].find("rebuild against the same .glb"), std::string::npos);
  EXPECT_NE(hosted.problems[1].find("variable knu::Robot::ready: node '" + node.name() + "' does not have it"),
            std::string::npos);
  joints[0].x = 1;  // private, harmless
  EXPECT_EQ(joints[0].x, 1.0);
  EXPECT_EQ(tick, 7U);
}

TEST(Refs, Follow_a_second_table_of_the_same_variable) {
  indurop::abi::Ref second[] = {row_of(tick)};
  second[0].entry = nullptr;
  indurop_register_refs(second, 1, indurop::abi::kVersion);
  EXPECT_EQ(second[0].entry, row_of(tick).entry) << "private memory is shared too";
  {
    TestNode node;
    const Hosted hosted(node);
    EXPECT_EQ(second[0].entry, row_of(tick).entry);
  }
  indurop_unregister_refs(second);
}

TEST(RefsDeathTest, Of_another_abi_end_the_program) {
  indurop::abi::Ref refs[] = {row_of(tick)};
  EXPECT_EXIT(indurop_register_refs(refs, 1, indurop::abi::kVersion + 1), ::testing::ExitedWithCode(8), "rebuild it");
}

TEST(Access, Faults_name_the_variable) {
  try {
    (void)joints[10].x.get();
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "knu::Robot::joints: index 10 is beyond its 10 elements");
  }
  auto held = lock(joints);
  EXPECT_THROW((void)lock(joints), std::runtime_error);
  held.discard();
}

TEST(Print, Streams_values_arrays_and_shapes) {
  std::ostringstream sut;
  joints_t value{1, 2.5, -3};
  joints = std::array<joints_t, 10>{value};
  label = "arm";
  ready = true;
  tick = 9;
  sut << value << ' ' << joints[0] << ' ' << tick << ' ' << label << ' ' << ready << ' ' << joints[0].y;
  EXPECT_EQ(sut.str(), "{x: 1, y: 2.5, z: -3} {x: 1, y: 2.5, z: -3} 9 arm 1 2.5");
  sut.str("");
  sut << joints;
  EXPECT_EQ(sut.str().substr(0, 50), "[{x: 1, y: 2.5, z: -3}, {x: 0, y: 0, z: 0}, {x: 0,");
  sut.str("");
  sut << joints.get();
  EXPECT_EQ(sut.str().substr(0, 24), "[{x: 1, y: 2.5, z: -3}, ");
}

}  // namespace
