// SPDX-License-Identifier: Apache-2.0
// What a module keeps goes to another instance of it whose variables lie elsewhere, with all addresses in it.

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "node/modules/module_memory.h"

namespace indurop::node {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

StateItem item(std::string_view name, std::string_view type, void* address, std::size_t size) {
  return {name.data(),
          static_cast<std::uint32_t>(name.size()),
          static_cast<std::uint32_t>(type.size()),
          type.data(),
          address,
          size};
}

// The variables of a module, as each process has its own.
struct Variables {
  std::array<std::int32_t, 4> row{};
  std::int64_t number = 0;
  struct Block {
    std::int32_t first = 0;
    std::int32_t second = 0;
  } block;
  std::int64_t shared = 0;
  StateAddress pointer;
  const void* interface = nullptr;

  std::vector<StateItem> items(std::string_view block_type = "place: FB #1") {
    return {item("row", "ARRAY", &row, sizeof row),
            item("number", "LINT", &number, sizeof number),
            item("block.first", "DINT", &block.first, sizeof block.first),
            item("block.second", "DINT", &block.second, sizeof block.second),
            item("p", "address: POINTER TO DINT", &pointer, sizeof pointer),
            item("i", "address: ITF", &interface, sizeof interface),
            item("block", block_type, &block, sizeof block),
            item("shared", "place: LINT", &shared, sizeof shared)};
  }
};

ModuleMemory memory_of(const std::vector<StateItem>& items) {
  StateDescriptor declared;
  declared.items = items.data();
  declared.item_count = static_cast<std::uint32_t>(items.size());
  return ModuleMemory(declared);
}

std::vector<std::uint8_t> saved(const ModuleMemory& memory) {
  std::vector<std::uint8_t> bytes(memory.most());
  bytes.resize(memory.save(std::as_writable_bytes(std::span(bytes))));
  return bytes;
}

class Addresses : public testing::Test {
 protected:
  std::vector<std::string> restore(const std::vector<StateItem>& into) {
    const ModuleMemory from = memory_of(old.items());
    const auto bytes = saved(from);
    EXPECT_FALSE(bytes.empty());
    return memory_of(into).restore(from.form(), bytes);
  }
  Variables old, now;
};

TEST_F(Addresses, Lead_to_the_same_variables_of_the_other_process) {
  old.row[2] = 7;
  old.pointer = {&old.row, sizeof old.row, 0};
  old.interface = &old.block.second;
  EXPECT_THAT(restore(now.items()), IsEmpty());
  EXPECT_EQ(now.row[2], 7);
  EXPECT_EQ(now.pointer.to, &now.row);
  EXPECT_EQ(now.pointer.size, sizeof now.row);
  EXPECT_EQ(now.interface, &now.block.second);
}

TEST_F(Addresses, Lead_to_whole_blocks_and_to_variables_that_are_not_kept) {
  old.pointer = {&old.block, sizeof old.block, 0};
  old.interface = &old.shared;
  old.shared = 5;
  EXPECT_THAT(restore(now.items()), IsEmpty());
  EXPECT_EQ(now.pointer.to, &now.block);
  EXPECT_EQ(now.interface, &now.shared);
  EXPECT_EQ(now.shared, 0);  // its value comes from elsewhere
}

TEST_F(Addresses, That_lead_nowhere_or_have_ended_stay_as_they_are) {
  old.interface = nullptr;
  old.pointer = {&old + 1, 4, 9};
  EXPECT_THAT(restore(now.items()), IsEmpty());
  EXPECT_EQ(now.interface, nullptr);
  EXPECT_EQ(now.pointer.to, &old + 1);
  EXPECT_EQ(now.pointer.ended, 9U);
}

TEST_F(Addresses, That_lead_to_what_is_not_kept_are_named_and_nothing_is_taken) {
  std::int64_t elsewhere = 0;
  old.pointer = {&elsewhere, sizeof elsewhere, 0};
  const ModuleMemory sut = memory_of(old.items());
  EXPECT_THAT(saved(sut), IsEmpty());
  EXPECT_EQ(sut.astray(), "p");
  old.pointer = {};
  EXPECT_EQ(sut.astray(), "");
  EXPECT_FALSE(saved(sut).empty());
}

TEST_F(Addresses, To_a_block_of_another_version_lead_nowhere_and_are_named) {
  old.pointer = {&old.block, sizeof old.block, 0};
  now.pointer = {&now.row, sizeof now.row, 0};
  EXPECT_THAT(restore(now.items("place: FB #2")), ElementsAre("block", "p"));
  EXPECT_EQ(now.pointer.to, nullptr);
}

TEST(ModuleMemory, An_array_with_more_elements_keeps_those_it_had) {
  std::array<double, 2> before{1, 2};
  std::array<double, 4> now{9, 9, 9, 9};
  const ModuleMemory from = memory_of({item("row", "double [2]", before.data(), sizeof before)});
  const ModuleMemory to = memory_of({item("row", "double [4]", now.data(), sizeof now)});
  EXPECT_THAT(to.restore(from.form(), saved(from)), IsEmpty());
  EXPECT_THAT(now, ElementsAre(1, 2, 9, 9));
  EXPECT_THAT(from.restore(to.form(), saved(to)), ElementsAre("row"));
  EXPECT_THAT(before, ElementsAre(1, 2));
}

}  // namespace
}  // namespace indurop::node
