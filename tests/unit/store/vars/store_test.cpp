// SPDX-License-Identifier: Apache-2.0

#include "store/vars/store.h"

#include <gtest/gtest.h>

#include "store/vars/tear_free_ring.h"
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

TEST(Store, Parts_outside_a_variable_are_refused) {
  const TestNode node("range");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  const DirectoryEntry& joints = *sut->find(hash("knu::Robot::joints"));
  std::vector<std::uint8_t> bytes(8);
  EXPECT_TRUE(sut->read(joints, 232, bytes).ok());
  EXPECT_EQ(sut->read(joints, 233, bytes).error().code, Errc::OutOfRange);
  EXPECT_EQ(sut->write(joints, 233, bytes).error().code, Errc::OutOfRange);
  EXPECT_EQ(sut->read(joints, 0xFFFFFFFF, bytes).error().code, Errc::OutOfRange);
  DirectoryEntry foreign = joints;
  foreign.offset = sut->header().total_size - 64;
  EXPECT_EQ(sut->read(foreign, 0, bytes).error().code, Errc::OutOfRange);
  EXPECT_EQ(sut->write(foreign, 0, bytes).error().code, Errc::OutOfRange);
}

TEST(Store, Part_of_a_scalar_leaves_the_rest) {
  const TestNode node("part");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  ASSERT_TRUE(put<std::uint32_t>(*sut, "knu::Robot::tick", 0x11223344).ok());
  ASSERT_TRUE(put<std::uint8_t>(*sut, "knu::Robot::tick", 0xFF, 1).ok());
  EXPECT_EQ(get<std::uint32_t>(*sut, "knu::Robot::tick"), 0x1122FF44U);
  EXPECT_EQ(get<std::uint16_t>(*sut, "knu::Robot::tick", 2), 0x1122U);
}

TEST(Store, Entries_are_found_by_name_and_type) {
  const TestNode node("entry");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  const std::uint64_t name = hash("knu::Robot::joints");
  const std::uint64_t type = sut->find(name)->type_hash;
  EXPECT_NE(sut->entry(name, type), nullptr);
  EXPECT_EQ(sut->entry(name, type), sut->entry(name, 0));
  EXPECT_EQ(sut->entry(name, type + 1), nullptr);
  EXPECT_EQ(sut->entry(name + 1, 0), nullptr);
}

TEST(Store, Thousands_of_variables_are_all_found) {
  const TestNode node("many");
  schema::Schema schema;
  for (int i = 0; i < 3000; ++i) {
    schema.variables.push_back(
        variable("plant::line_" + std::to_string(i % 10) + "::value" + std::to_string(i),
                 i % 3 == 0 ? array_type(schema::Base::Float, 64) : scalar_type(schema::Base::Int64)));
  }
  ASSERT_TRUE(Store::create(node.name(), schema).ok());
  auto sut = Store::attach(node.name(), Mode::ReadWrite);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->directory().size(), 3000U);
  for (const schema::Variable& variable : schema.variables) {
    const DirectoryEntry* entry = sut->find(variable.name_hash());
    ASSERT_NE(entry, nullptr) << variable.name;
    EXPECT_EQ(sut->schema().variables[entry->schema_index].name, variable.name);
    EXPECT_EQ(entry->value_size, variable.type.size());
  }
  sut->prefault();
}

TEST(Store, Large_array_is_written_in_parts_and_whole) {
  const TestNode node("large");
  constexpr std::uint32_t kCount = 1'250'000;  // 10 MB
  schema::Schema schema;
  schema.variables.push_back(variable("image", array_type(schema::Base::Double, kCount)));
  auto sut = Store::create(node.name(), schema);
  ASSERT_TRUE(sut.ok());
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(put(*sut, "image", i + 0.5, i * 8 * 12'000).ok());
  }
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_EQ(get<double>(*sut, "image", i * 8 * 12'000), i + 0.5);
  }
  const std::vector<std::uint8_t> whole(std::size_t{kCount} * 8, 0x11);
  ASSERT_TRUE(sut->write(*sut->find(hash("image")), 0, whole).ok());
  std::vector<std::uint8_t> back(whole.size());
  ASSERT_TRUE(sut->read(*sut->find(hash("image")), 0, back).ok());
  EXPECT_EQ(back, whole);
  sut->reset(false);
  EXPECT_EQ(get<double>(*sut, "image", (kCount - 1) * 8), 0.0);
}

TEST(Store, Locks_left_by_a_fault_are_released) {
  const TestNode node("release");
  auto sut = Store::create(node.name(), figure_3());
  ASSERT_TRUE(sut.ok());
  auto& ring = *static_cast<abi::RingHeader*>(sut->entry(hash("knu::Robot::joints"), 0));
  auto* slot = static_cast<unsigned char*>(begin_edit(ring));
  ASSERT_NE(slot, nullptr);
  std::memset(slot, 0xFF, 240);
  sut->release_locks_of_this_thread();
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints"), 0.0);
  EXPECT_TRUE(put(*sut, "knu::Robot::joints", 1.0, 8).ok());
  EXPECT_EQ(get<double>(*sut, "knu::Robot::joints"), 0.0);
}

TEST(Store, Heartbeat_and_end_of_the_node_are_seen_by_others) {
  const TestNode node("beat");
  auto viewer = [&] { return Store::attach(node.name(), Mode::ReadOnly); };
  {
    auto sut = Store::create(node.name(), figure_3());
    ASSERT_TRUE(sut.ok());
    sut->beat(rt::mono_time(1234));
    EXPECT_EQ(viewer()->header().heartbeat_ns.load(), 1234);
    EXPECT_EQ(viewer()->header().node_pid.load(), ::getpid());
  }
  EXPECT_EQ(viewer()->header().node_pid.load(), 0);
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
