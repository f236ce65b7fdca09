// SPDX-License-Identifier: Apache-2.0
// Values as CDR and back.

#include "history/recording/cdr.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/unit/core/schema/types.h"
#include "tests/unit/history/recording/random_value.h"

namespace indurop::recording {
namespace {

using schema::Base;
using schema::number;
using schema::structure;
using schema::text;
using schema::Type;
using testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const Type& type, const Bytes& value) {
  Bytes out;
  EXPECT_TRUE(to_cdr(type, value, out).ok());
  return out;
}

Errc decoded(const Type& type, const Bytes& cdr) {
  Bytes value(type.size());
  return from_cdr(type, cdr, value).error().code;
}

TEST(Cdr, A_struct_in_a_struct_has_no_padding_of_its_own) {
  // C leaves three bytes after `flag` and three after `mode`; CDR aligns the numbers alone.
  const Type inner = structure("inner", {{"count", number(Base::UInt32)}, {"flag", number(Base::UInt8)}});
  const Type outer = structure("outer", {{"inner", inner}, {"mode", number(Base::UInt8)}});
  EXPECT_THAT(encoded(outer, {1, 0, 0, 0, 2, 9, 9, 9, 3, 9, 9, 9}), ElementsAre(0, 1, 0, 0, 1, 0, 0, 0, 2, 3));
}

TEST(Cdr, Alignment_counts_from_behind_the_header) {
  const Type type = structure("t", {{"a", number(Base::UInt8)}, {"b", number(Base::UInt64)}});
  EXPECT_THAT(encoded(type, {1, 9, 9, 9, 9, 9, 9, 9, 2, 0, 0, 0, 0, 0, 0, 0}),
              ElementsAre(0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0));
}

TEST(Cdr, Text_is_a_string_up_to_its_end) {
  EXPECT_THAT(encoded(text(4), {'h', 'i', 0, 'x'}), ElementsAre(0, 1, 0, 0, 3, 0, 0, 0, 'h', 'i', 0));
  EXPECT_THAT(encoded(text(4), {'l', 'o', 'n', 'g'}), ElementsAre(0, 1, 0, 0, 4, 0, 0, 0, 'l', 'o', 'n', 0));
  EXPECT_THAT(encoded(text(4), {0, 'x', 'x', 'x'}), ElementsAre(0, 1, 0, 0, 1, 0, 0, 0, 0));
}

TEST(Cdr, Random_values_come_back) {
  RandomValue random(1);
  for (int i = 0; i < 2000; ++i) {
    const Type type = random.type();
    const Bytes value = random.value(type);
    Bytes back(value.size(), 0xAA);
    ASSERT_TRUE(from_cdr(type, encoded(type, value), back).ok()) << schema::canonical(type);
    ASSERT_EQ(back, value) << schema::canonical(type);
  }
}

TEST(Cdr, Numbers_without_gaps_lie_in_memory_as_in_CDR) {
  RandomValue random(3);
  int so = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Type type = random.type();
    Bytes value(type.size());  // any bytes, in gaps too
    std::generate(value.begin(), value.end(), [&] { return static_cast<std::uint8_t>(random.below(256)); });
    Bytes copied(kCdrHead.begin(), kCdrHead.end());
    copied.insert(copied.end(), value.begin(), value.end());
    if (lies_as_cdr(type)) {
      ASSERT_EQ(encoded(type, value), copied) << schema::canonical(type);
      so += type.base == Base::Struct ? 1 : 0;
    }
  }
  EXPECT_GT(so, 100);
  EXPECT_TRUE(lies_as_cdr(structure("pair", {{"a", number(Base::Double)}, {"b", number(Base::UInt64)}})));
  EXPECT_FALSE(lies_as_cdr(structure("gap", {{"a", number(Base::UInt8)}, {"b", number(Base::UInt64)}})));
  EXPECT_FALSE(lies_as_cdr(structure("end", {{"a", number(Base::UInt64)}, {"b", number(Base::UInt8)}})));
  EXPECT_FALSE(lies_as_cdr(number(Base::Bool))) << "memory may hold a 2";
  EXPECT_FALSE(lies_as_cdr(text(4)));
}

TEST(Cdr, What_is_no_value_of_the_type_is_refused) {
  RandomValue random(2);
  for (int i = 0; i < 300; ++i) {
    const Type type = random.type();
    Bytes cdr = encoded(type, random.value(type));
    for (std::size_t size = 0; size < cdr.size(); ++size) {
      ASSERT_EQ(decoded(type, Bytes(cdr.begin(), cdr.begin() + static_cast<std::ptrdiff_t>(size))), Errc::Corrupt);
    }
    cdr.push_back(0);
    ASSERT_EQ(decoded(type, cdr), Errc::Corrupt);
  }
  EXPECT_EQ(decoded(number(Base::Bool), {0, 1, 0, 0, 2}), Errc::Corrupt);
  EXPECT_EQ(decoded(number(Base::Int8), {0, 0, 0, 0, 2}), Errc::Unsupported);
  EXPECT_EQ(decoded(text(3), {0, 1, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0}), Errc::Corrupt);  // too long
  EXPECT_EQ(decoded(text(3), {0, 1, 0, 0, 2, 0, 0, 0, 'a', 'b'}), Errc::Corrupt);          // does not end
  EXPECT_EQ(decoded(text(3), {0, 1, 0, 0, 0, 0, 0, 0}), Errc::Corrupt);
  Bytes out;
  EXPECT_EQ(to_cdr(number(Base::Int16), Bytes(3), out).error().code, Errc::InvalidArgument);
}

}  // namespace
}  // namespace indurop::recording
