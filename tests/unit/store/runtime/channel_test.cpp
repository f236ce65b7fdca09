// SPDX-License-Identifier: Apache-2.0
// Variables by name, called as in Figure 8: unqualified, although POSIX has functions of these names.

#include <gtest/gtest.h>
#include <indurop/indurop.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include <indurop/generated.h>
#include "hosted.h"

namespace {

using indurop::Errc;
using indurop::testing::Hosted;
using indurop::testing::TestNode;
namespace robot = knu::Robot;

constexpr std::ptrdiff_t error(Errc code) {
  return -static_cast<std::ptrdiff_t>(code);
}

TEST(Channel, Reads_and_writes_parts_by_name) {
  TestNode node;
  const Hosted hosted(node);
  robot::joints[1] = {1, 2, 3};
  channel::Handle sut;
  ASSERT_EQ(connect(sut, node.name().c_str()), 0);
  double y = 0;
  EXPECT_EQ(read(sut, "joints[1].y", sizeof(y), &y), 8);
  EXPECT_EQ(y, 2.0);
  y = 5;
  EXPECT_EQ(write(sut, "knu::Robot::joints[1].y", sizeof(y), &y), 8);
  EXPECT_EQ(robot::joints[1].get(), (robot::joints_t{1, 5, 3}));
  EXPECT_EQ(read<std::uint32_t>(sut, "tick").value(), 7U);
  EXPECT_TRUE(write(sut, "tick", 8U));
  EXPECT_EQ(robot::tick, 8U);
  EXPECT_EQ(read<robot::joints_t>(sut, "joints[1]").value().y, 5.0);
}

TEST(Channel, Of_wrong_names_and_sizes_says_what_is_wrong) {
  TestNode node;
  const Hosted hosted(node);
  channel::Handle sut;
  ASSERT_EQ(connect(sut, node.name().c_str()), 0);
  double y = 4;
  EXPECT_EQ(read(sut, "joint[1].y", sizeof(y), &y), error(Errc::NotFound));
  EXPECT_EQ(read(sut, "joints[10].y", sizeof(y), &y), error(Errc::OutOfRange));
  EXPECT_EQ(read(sut, "joints[1", sizeof(y), &y), error(Errc::InvalidArgument));
  EXPECT_EQ(read(sut, "joints[1].y", 4, &y), error(Errc::TypeMismatch));
  EXPECT_EQ(read<float>(sut, "tick").error().code, Errc::TypeMismatch);
  EXPECT_EQ(read<std::int32_t>(sut, "tick").error().code, Errc::TypeMismatch);
  EXPECT_EQ(write(sut, "joints[1].y", std::int64_t{1}).error().code, Errc::TypeMismatch);
  EXPECT_EQ(y, 4.0);
  const auto lines = indurop::runtime::take_binding_errors();
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("joints"), std::string::npos) << "proposes the nearest name: " << lines[0];
  EXPECT_EQ(read(sut, "joint[1].y", sizeof(y), &y), error(Errc::NotFound));
  EXPECT_TRUE(indurop::runtime::take_binding_errors().empty()) << "one message per name";
}

TEST(Channel, Connects_to_another_node_and_follows_its_new_block) {
  TestNode node;
  channel::Handle sut;
  ASSERT_EQ(connect(sut, node.name().c_str()), 0);
  EXPECT_EQ(read<std::uint32_t>(sut, "tick").value(), 7U);
  auto schema = indurop::testing::sample_schema();
  schema.variables.erase(schema.variables.begin() + 1);
  schema.variables[0].initial = {9, 0, 0, 0};
  ASSERT_TRUE(write(sut, "tick", 100U));
  node.restart(schema, {{"m", {}, 0, {}, ""}});
  EXPECT_EQ(read<std::uint32_t>(sut, "tick").value(), 100U) << "carried over";
  EXPECT_EQ(read<double>(sut, "joints[1].y").error().code, Errc::NotFound);
}

// From now on the node has a variable of this type.
void bring(TestNode& node, const std::string& name, indurop::schema::Base base) {
  indurop::schema::Variable made;
  made.name = name;
  made.type.base = base;
  made.type.element_size = base == indurop::schema::Base::Double ? 8 : 4;
  made.type.align = made.type.element_size;
  made.kind = indurop::abi::Kind::Scalar;
  made.type_hash = indurop::schema::hash_of(made.type);
  const std::vector all{made};
  ASSERT_TRUE(node.store().reserve(all).ok());
  auto next = node.store().prepare(all);
  ASSERT_TRUE(next.ok());
  node.store().announce(std::move(next).value());
}

void expect_to_follow(TestNode& node, channel::Handle& sut) {
  ASSERT_EQ(connect(sut, node.name().c_str()), 0);
  EXPECT_EQ(read<std::uint32_t>(sut, "tick").value(), 7U);
  EXPECT_EQ(read<double>(sut, "nt::late").error().code, Errc::NotFound);
  bring(node, "nt::late", indurop::schema::Base::Float);
  EXPECT_TRUE(write(sut, "nt::late", 2.5F));
  EXPECT_EQ(read<float>(sut, "nt::late").value(), 2.5F);
  EXPECT_EQ(read<double>(sut, "nt::late").error().code, Errc::TypeMismatch);
  bring(node, "nt::late", indurop::schema::Base::Double);
  EXPECT_EQ(read<float>(sut, "nt::late").error().code, Errc::TypeMismatch);
  EXPECT_TRUE(write(sut, "nt::late", 4.5));
  EXPECT_EQ(read<double>(sut, "nt::late").value(), 4.5);
  bring(node, "nt::late", indurop::schema::Base::Float);
  EXPECT_EQ(read<float>(sut, "nt::late").value(), 2.5F);
  EXPECT_EQ(read<std::uint32_t>(sut, "tick").value(), 7U);
}

TEST(Channel, Follows_variables_that_appear_or_get_another_type) {
  TestNode node;
  channel::Handle sut;
  expect_to_follow(node, sut);
}

TEST(Channel, Of_a_module_follows_variables_that_appear_or_get_another_type) {
  TestNode node;
  const Hosted hosted(node);
  channel::Handle sut;
  expect_to_follow(node, sut);
}

TEST(Channel, Without_a_node_is_an_error_not_a_wait) {
  channel::Handle sut;
  EXPECT_EQ(connect(sut, "rttest-missing"), static_cast<int>(error(Errc::NotFound)));
  EXPECT_EQ(connect(sut, "not a name"), static_cast<int>(error(Errc::InvalidArgument)));
  double y = 0;
  EXPECT_LT(read(sut, "joints[1].y", sizeof(y), &y), 0);
}

}  // namespace
