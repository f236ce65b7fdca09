// SPDX-License-Identifier: Apache-2.0
// Runs the generated proxies against a store made of plain memory: they must touch exactly the bytes that the schema
// says, because tools, DDS and other processes find values by the schema.

#include <gtest/gtest.h>
#include <indurop/generated.h>

#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"

namespace {

using indurop::abi::Kind;
using indurop::abi::Ref;
using indurop::abi::RingHeader;

constexpr std::align_val_t kCacheLine{64};

struct Memory {
  std::map<std::string, Ref*> refs;
  int registrations = 0;
};
// Never destroyed: the tables are withdrawn after all static objects are gone.
Memory& memory() {
  static auto* const kInstance = new Memory;
  return *kInstance;
}

unsigned char* slot(RingHeader* ring, std::uint64_t seq) {
  return reinterpret_cast<unsigned char*>(ring + 1) + (seq % indurop::abi::kSlots) * ring->slot_stride;
}

}  // namespace

extern "C" {

void indurop_register_refs(Ref* refs, std::uint32_t count, std::uint32_t /*abi_version*/) {
  ++memory().registrations;
  for (std::uint32_t i = 0; i < count; ++i) {
    Ref& ref = refs[i];
    const std::size_t size = indurop::abi::entry_size(ref.kind, ref.value_size);
    ref.entry = ::operator new(size, kCacheLine);
    std::memset(ref.entry, 0, size);
    auto* value = static_cast<unsigned char*>(ref.entry);
    if (ref.kind == Kind::Ring) {
      auto* ring = static_cast<RingHeader*>(ref.entry);
      ring->value_size = ref.value_size;
      ring->slot_stride = static_cast<std::uint32_t>(indurop::abi::slot_stride(ref.value_size));
      value = slot(ring, 0);
    }
    if (ref.initial != nullptr) {
      std::memcpy(value, ref.initial, ref.value_size);
    }
    memory().refs[ref.name] = &ref;
  }
}
void indurop_unregister_refs(Ref* /*refs*/) {
  for (const auto& [name, ref] : memory().refs) {
    ::operator delete(ref->entry, kCacheLine);
  }
}
void* indurop_begin_edit(RingHeader* ring) noexcept {
  const std::uint64_t seq = ring->seq.load();
  std::memcpy(slot(ring, seq + 1), slot(ring, seq), ring->value_size);
  return slot(ring, seq + 1);
}
void* indurop_begin_write(RingHeader* ring, std::uint32_t /*offset*/, std::uint32_t /*length*/) noexcept {
  return indurop_begin_edit(ring);
}
void indurop_commit_write(RingHeader* ring) noexcept {
  ring->seq.fetch_add(1);
}
void indurop_abort_write(RingHeader* /*ring*/) noexcept {}
bool indurop_hold_scalar(void* /*entry*/) noexcept {
  return false;
}
void indurop_read_slow(const RingHeader* /*ring*/, void* /*to*/, std::uint32_t /*offset*/,
                       std::uint32_t /*length*/) noexcept {}
void indurop_index_fault(const char* variable, std::uint64_t /*index*/, std::uint64_t /*bound*/) {
  throw std::out_of_range(variable);
}
void indurop_lock_fault(const char* variable) {
  throw std::runtime_error(variable);
}

}  // extern "C"

namespace indurop::glb2idl {
namespace {

class Generated : public ::testing::Test {
 protected:
  Generated() : compilation_(compile({SAMPLE_GLB})), schema_(schema_of(compilation_.program.units[0])) {}

  // The bytes that the schema says belong to "all.path[1][0].x" and the like.
  template <class T>
  [[nodiscard]] T bytes(const std::string& text) const {
    const auto place = schema::find_place(schema_, text);
    EXPECT_TRUE(place.ok()) << text;
    EXPECT_EQ(place->type.size(), sizeof(T)) << text;
    const Ref* ref = memory().refs.at(place->variable->name);
    const unsigned char* value = static_cast<unsigned char*>(ref->entry);
    if (ref->kind == Kind::Ring) {
      auto* ring = static_cast<RingHeader*>(ref->entry);
      value = slot(ring, ring->seq.load());
    }
    T result{};
    std::memcpy(&result, value + place->offset, sizeof result);
    return result;
  }

  Compilation compilation_;
  schema::Schema schema_;
};

TEST_F(Generated, Header_and_schema_agree_on_every_variable) {
  EXPECT_EQ(memory().registrations, 1) << "two source files include the header";
  ASSERT_EQ(schema_.variables.size(), memory().refs.size());
  for (const schema::Variable& v : schema_.variables) {
    const Ref* ref = memory().refs.at(v.name);
    EXPECT_EQ(ref->name_hash, v.name_hash());
    EXPECT_EQ(ref->type_hash, schema::hash_of(v.type));
    EXPECT_EQ(ref->value_size, v.type.size());
    EXPECT_EQ(ref->kind, v.kind);
    ASSERT_EQ(ref->initial == nullptr, v.initial.empty()) << v.name;
    if (ref->initial != nullptr && v.name != "sample::name") {
      EXPECT_EQ(std::memcmp(ref->initial, v.initial.data(), v.initial.size()), 0) << v.name;
    }
  }
}

TEST_F(Generated, Initial_values_are_there_before_anything_runs) {
  EXPECT_TRUE(sample::flag);
  EXPECT_EQ(sample::mode.get(), sample::AUTO);
  EXPECT_EQ(sample::name.get(), "abc");
  EXPECT_EQ(sample::pos.get(), (sample::Pos{1.5, -2}));
}

TEST_F(Generated, Writes_land_where_the_schema_says) {
  sample::number = 7;
  sample::number += 3;
  EXPECT_EQ(bytes<std::int32_t>("number"), 10);
  sample::all.small = -3;
  EXPECT_EQ(bytes<std::int8_t>("all.small"), -3);
  sample::all.labels[1] = "xyz";
  const auto label = bytes<std::array<char, 8>>("all.labels[1]");
  EXPECT_STREQ(label.data(), "xyz");
  sample::all.modes[2] = sample::MANUAL;
  EXPECT_EQ(bytes<std::int32_t>("all.modes[2]"), 2);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double value = 10.0 * static_cast<double>(i) + static_cast<double>(k);
      sample::all.path[i][k].y = value;
      EXPECT_EQ(bytes<double>("all.path[" + std::to_string(i) + "][" + std::to_string(k) + "].y"), value);
    }
  }
  sample::all.inner[3].b[1] = 99;
  EXPECT_EQ(bytes<std::int64_t>("all.inner[3].b[1]"), 99);
  sample::grid[3][4] = -4;
  EXPECT_EQ(bytes<std::int16_t>("grid[3][4]"), -4);
  sample::pos.y = 8;
  EXPECT_EQ(bytes<double>("pos.y"), 8);
  EXPECT_EQ(bytes<double>("pos.x"), 1.5) << "the rest stays";
}

TEST_F(Generated, Whole_structs_and_arrays_move_in_one_piece) {
  sample::all_t whole = sample::all;
  whole.path[2][1] = {3, 4};
  whole.inner[0].a = 5;
  sample::all = whole;
  EXPECT_EQ(bytes<double>("all.path[2][1].y"), 4);
  EXPECT_TRUE(sample::all == whole);
  sample::all.path[0] = sample::all.path[2];
  EXPECT_EQ(bytes<double>("all.path[0][1].x"), 3);
  sample::pos = sample::all.path[0][1];
  EXPECT_EQ(bytes<double>("pos.x"), 3);
  auto locked = lock(sample::grid);
  locked[1][2] = 12;
  EXPECT_NE(bytes<std::int16_t>("grid[1][2]"), 12);
}

TEST_F(Generated, Indices_are_checked) {
  volatile std::size_t beyond = 4;
  EXPECT_THROW(sample::grid[beyond][0] = 1, std::out_of_range);
}

TEST_F(Generated, Fields_can_be_visited) {
  std::string names;
  indurop_fields(sample::Pos{1, 2},
                 [&](const char* name, double value) { names += name + std::to_string(static_cast<int>(value)); });
  EXPECT_EQ(names, "x1y2");
  static_assert(sample::LIMIT == 12);
}

}  // namespace
}  // namespace indurop::glb2idl
