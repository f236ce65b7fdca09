// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/record.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace indurop::serve {
namespace {

tools::Item item(schema::Base base, std::uint32_t size, std::uint32_t align, std::vector<std::uint32_t> dims = {}) {
  tools::Item out;
  out.place.type.base = base;
  out.place.type.element_size = size;
  out.place.type.align = align;
  out.place.type.dims = std::move(dims);
  return out;
}

template <class T>
T at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(Record, Puts_values_on_their_alignment_and_qualities_behind) {
  const Record record({item(schema::Base::Bool, 1, 1), item(schema::Base::Double, 8, 8),
                       item(schema::Base::UInt16, 2, 2, {3}), item(schema::Base::UInt32, 4, 4)});
  EXPECT_EQ(record.offset(0), 40U);
  EXPECT_EQ(record.offset(1), 48U);
  EXPECT_EQ(record.offset(2), 56U);
  EXPECT_EQ(record.offset(3), 64U);
  EXPECT_EQ(record.quality_offset(), 68U);
  EXPECT_EQ(record.bytes().size(), 72U);
}

TEST(Record, Has_its_head_as_the_document_says) {
  Record record({});
  record.set_head({true, true, 7, 12, 5, 1'700'000'000'000'000'000});
  const auto bytes = record.bytes();
  ASSERT_EQ(bytes.size(), Record::kHeadSize);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_EQ(bytes[1], 1);
  EXPECT_EQ(at<std::uint16_t>(bytes, 2), 3);
  EXPECT_EQ(at<std::uint32_t>(bytes, 4), 7U);
  EXPECT_EQ(at<std::uint64_t>(bytes, 8), 12U);
  EXPECT_EQ(at<std::int64_t>(bytes, 16), 5);
  EXPECT_EQ(at<std::int64_t>(bytes, 24), 1'700'000'000'000'000'000);
  EXPECT_EQ(at<std::int64_t>(bytes, 32), 0);
}

TEST(Record, Says_whether_a_value_changed) {
  Record record({item(schema::Base::UInt32, 4, 4)});
  const std::array<std::uint8_t, 4> value{1, 2, 3, 4};
  EXPECT_TRUE(record.set_value(0, value));
  EXPECT_FALSE(record.set_value(0, value));
  EXPECT_EQ(record.value(0, 4)[3], 4);
  record.set_quality(0, Quality::Silent, true);
  EXPECT_EQ(record.bytes()[record.quality_offset()], 2 | Record::kForced);
}

}  // namespace
}  // namespace indurop::serve
