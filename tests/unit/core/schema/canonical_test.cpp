// SPDX-License-Identifier: Apache-2.0
// The canonical text is what programs of different builds and machines agree on: its exact letters are the contract.

#include <gmock/gmock.h>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

TEST(Canonical, Text_of_every_kind_of_type_is_fixed) {
  EXPECT_EQ(canonical(joints_type()), "struct(24,8){x@0:f64,y@8:f64,z@16:f64}[10]");
  EXPECT_EQ(canonical(mode_type()), "enum{Off=0,Manual=1,Auto=2}");
  EXPECT_EQ(canonical(text(16, {4})), "text(16)[4]");
  EXPECT_EQ(canonical(number(Base::UInt32, {2, 3})), "u32[2][3]");
  EXPECT_EQ(
      canonical(structure("s", {{"a", number(Base::Bool)}, {"b", number(Base::Int16)}, {"c", number(Base::Char)}})),
      "struct(6,2){a@0:bool,b@2:i16,c@4:char}");
}

TEST(Canonical, Hash_of_a_known_type_is_the_same_everywhere) {
  EXPECT_EQ(hash_of(number(Base::UInt32)), abi::fnv1a64("u32", 3));
  EXPECT_EQ(hash_of(number(Base::UInt32)), 0x4D2BDF193E8526D1ULL);
}

TEST(Canonical, Names_of_types_units_and_comments_do_not_matter) {
  Type other = joints_type();
  other.name = "something::else";
  other.fields[0].unit = "rad";
  other.fields[1].description = "the second";
  other.fields[2].range = Range{0, 1};
  EXPECT_EQ(hash_of(other), hash_of(joints_type()));
}

TEST(Canonical, Everything_that_moves_bytes_changes_the_hash) {
  const std::uint64_t hash = hash_of(joints_type());
  Type changed = joints_type();
  changed.fields[0].name = "X";
  EXPECT_NE(hash_of(changed), hash);
  changed = joints_type();
  changed.fields[2].offset = 12;
  EXPECT_NE(hash_of(changed), hash);
  changed = joints_type();
  changed.element_size = 32;
  EXPECT_NE(hash_of(changed), hash);
  changed = joints_type();
  changed.dims = {11};
  EXPECT_NE(hash_of(changed), hash);
  changed = mode_type();
  changed.enumerators[1].value = 5;
  EXPECT_NE(hash_of(changed), hash_of(mode_type()));
}

TEST(Canonical, Function_hash_covers_parameters_and_result_but_not_the_deadline) {
  Function add;
  add.arguments = structure("add_args", {{"a", number(Base::Double)}});
  add.result = number(Base::Double);
  Function same = add;
  same.deadline_ns = 5;
  EXPECT_EQ(hash_of(add), hash_of(same));
  Function other = add;
  other.result = number(Base::Float);
  EXPECT_NE(hash_of(add), hash_of(other));
  Function nothing = add;
  nothing.result = structure("", {});
  Function nothing_else = nothing;
  nothing_else.result.element_size = 1;
  EXPECT_EQ(hash_of(nothing), hash_of(nothing_else));
}

TEST(Canonical, Size_multiplies_dims_and_saturates) {
  EXPECT_EQ(joints_type().size(), 240U);
  EXPECT_EQ(number(Base::Double, {UINT32_MAX, UINT32_MAX, UINT32_MAX}).size(), UINT64_MAX);
}

TEST(Canonical, Display_names_read_like_C) {
  EXPECT_EQ(display_name(joints_type()), "knu::Robot::joints_t[10]");
  EXPECT_EQ(display_name(text(16)), "char[16]");
  EXPECT_EQ(display_name(text(16, {4})), "char[4][16]");
  EXPECT_EQ(display_name(number(Base::UInt8, {2, 3})), "uint8_t[2][3]");
}

}  // namespace
}  // namespace indurop::schema
