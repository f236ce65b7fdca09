// SPDX-License-Identifier: Apache-2.0

#include "vars/store.h"

#include <gtest/gtest.h>

#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

schema::Schema figure_3() {
  schema::Schema schema;
  schema.variables.push_back(variable("knu::Robot::tick", scalar_type(schema::Base::UInt32)));
  schema.variables.push_back(variable("knu::Robot::joints", array_type(schema::Base::Double, 30), true));
  schema.variables[0].initial = bytes_of<std::uint32_t>(7);
  return schema;
}

template <class T>
T get(const Store& store, const std::string& name, std::uint32_t offset = 0) {
  T value{};
  std::uint8_t bytes[sizeof(T)] = {};
  const DirectoryEntry* entry = store.find(hash(name));
  EXPECT_NE(entry, nullptr);
  if (entry != nullptr) {
    EXPECT_TRUE(store.read(*entry, offset, bytes).ok());
  }
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <class T>
Status put(Store& store, const std::string& name, T value, std::uint32_t offset = 0) {
  return store.write(*store.find(hash(name)), offset, bytes_of(value));
}

TEST(Store, Fresh_store_holds_initial_values) {
  const TestNode node("fresh");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  EXPECT_EQ(sut->origin(), Origin::Fresh);
  EXPECT_EQ(get<std::uint32_t>(*sut, "knu::Robot::tick"), 7U);
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints", 8), 0.0);
  EXPECT_EQ(sut->header().node_pid.load(), ::getpid());
}

TEST(Store, What_one_writes_the_attached_read) {
  const TestNode node("attach");
  auto writer = Store::create(node.name(), figure_3());
  ASSERT_TRUE(writer.ok());
  auto other = Store::attach(node.name(), Mode::ReadWrite);
  auto viewer = Store::attach(node.name(), Mode::ReadOnly);
  ASSERT_TRUE(other.ok());
  ASSERT_TRUE(viewer.ok());
  ASSERT_TRUE(put(*other, "knu::Robot::joints", 1.5, 232).ok());
  ASSERT_TRUE(put<std::uint32_t>(*writer, "knu::Robot::tick", 99).ok());
  EXPECT_EQ(get<double>(*viewer, "knu::Robot::joints", 232), 1.5);
  EXPECT_EQ(get<std::uint32_t>(*viewer, "knu::Robot::tick"), 99U);
  EXPECT_EQ(put(*viewer, "knu::Robot::joints", 2.5).error().code, Errc::PermissionDenied);
}

TEST(Store, Same_layout_is_adopted_with_values) {
  const TestNode node("adopt");
  std::uint64_t generation = 0;
  {
    auto first = Store::create(node.name(), figure_3());
    ASSERT_TRUE(first.ok());
    generation = first->header().generation.load();
    ASSERT_TRUE(put(*first, "knu::Robot::joints", 3.25, 16).ok());
  }
  auto client = Store::attach(node.name(), Mode::ReadWrite);
  ASSERT_TRUE(client.ok());
  EXPECT_EQ(client->header().node_pid.load(), 0);
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::Adopted);
  EXPECT_EQ(sut->header().generation.load(), generation + 1);
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints", 16), 3.25);
  EXPECT_FALSE(client->retired());
  ASSERT_TRUE(put(*sut, "knu::Robot::joints", 4.0).ok());
  EXPECT_EQ(get<double>(*client, "knu::Robot::joints"), 4.0);
}

TEST(Store, Another_layout_retires_the_block_and_carries_values_over) {
  const TestNode node("carry");
  auto old_store = Store::create(node.name(), figure_3());
  ASSERT_TRUE(old_store.ok());
  ASSERT_TRUE(put(*old_store, "knu::Robot::joints", 3.25, 16).ok());
  ASSERT_TRUE(put<std::uint32_t>(*old_store, "knu::Robot::tick", 11).ok());
  schema::Schema changed = figure_3();
  changed.variables[0].type = scalar_type(schema::Base::Int32);
  changed.variables[0].type_hash = schema::hash_of(changed.variables[0].type);
  changed.variables.push_back(variable("knu::Robot::more", scalar_type(schema::Base::Bool)));
  auto sut = Store::create(node.name(), changed);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->origin(), Origin::CarriedOver);
  EXPECT_TRUE(old_store->retired());
  EXPECT_FALSE(sut->retired());
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints", 16), 3.25);
  EXPECT_EQ(get<std::uint32_t>(*sut, "knu::Robot::tick"), 7U);
  EXPECT_GT(sut->header().generation.load(), old_store->header().generation.load());
}

TEST(Store, Reset_restores_initial_values) {
  const TestNode node("reset");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  ASSERT_TRUE(put(*sut, "knu::Robot::joints", 3.25, 16).ok());
  ASSERT_TRUE(put<std::uint32_t>(*sut, "knu::Robot::tick", 11).ok());
  sut->reset(true);
  EXPECT_EQ(get<std::uint32_t>(*sut, "knu::Robot::tick"), 7U);
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints", 16), 3.25);
  sut->reset(false);
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints", 16), 0.0);
}

}  // namespace
}  // namespace indurop::vars
