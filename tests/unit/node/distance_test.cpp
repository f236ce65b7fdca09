// SPDX-License-Identifier: Apache-2.0
#include "node/replay/distance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <vector>

namespace indurop::node {
namespace {

using schema::Base;

template <class T>
std::vector<std::uint8_t> bytes_of(const T& value) {
  std::vector<std::uint8_t> bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

schema::Variable variable(Base base, std::uint32_t size, std::vector<std::uint32_t> dims = {}) {
  schema::Variable one;
  one.name = "a::x";
  one.type.base = base;
  one.type.element_size = size;
  one.type.dims = std::move(dims);
  return one;
}

template <class T>
Distance between(Base base, const T& a, const T& b, std::vector<std::uint32_t> dims = {}) {
  const std::size_t count = dims.empty() ? 1 : dims.front();
  const auto size = static_cast<std::uint32_t>(sizeof(T) / count);
  return distance(variable(base, size, std::move(dims)), bytes_of(a), bytes_of(b));
}

TEST(Distance, Is_that_of_two_numbers_of_any_size) {
  EXPECT_EQ(between(Base::Double, 1.5, -2.0).largest, 3.5);
  EXPECT_EQ(between(Base::UInt8, std::uint8_t{3}, std::uint8_t{250}).largest, 247);
  EXPECT_EQ(between(Base::Int64, std::int64_t{1} << 62, (std::int64_t{1} << 62) + 1).largest, 1);
  EXPECT_EQ(between(Base::UInt64, std::uint64_t{0}, ~std::uint64_t{0}).largest, 18446744073709551615.0);
  EXPECT_EQ(between(Base::Bool, true, false).largest, 1);
  EXPECT_EQ(between(Base::Int32, 7, 7).largest, 0);
}

TEST(Distance, Is_the_largest_one_of_an_array_and_names_it) {
  const std::array a{1, 5, 9};
  const std::array b{1, 4, 13};
  const Distance sut = between(Base::Int32, a, b, {3});
  EXPECT_EQ(sut.largest, 4);
  EXPECT_EQ(sut.part, "a::x[2]");
}

TEST(Distance, Looks_into_structures_and_not_at_their_padding) {
  struct Pair {
    std::uint8_t flag = 0;
    double value = 0;
  };
  schema::Variable one = variable(Base::Struct, sizeof(Pair));
  for (const auto& [name, base, size, offset] :
       {std::tuple("flag", Base::UInt8, 1U, 0U), std::tuple("value", Base::Double, 8U, 8U)}) {
    schema::Field& field = one.type.fields.emplace_back();
    field.name = name;
    field.type = variable(base, size).type;
    field.offset = offset;
  }
  std::vector<std::uint8_t> a = bytes_of(Pair{1, 2.0});
  std::vector<std::uint8_t> b = bytes_of(Pair{1, 2.0});
  a[4] = 7;
  b[4] = 9;
  EXPECT_EQ(distance(one, a, b).largest, 0);
  const double value = 2.25;
  std::memcpy(b.data() + 8, &value, sizeof value);
  const Distance sut = distance(one, a, b);
  EXPECT_EQ(sut.largest, 0.25);
  EXPECT_EQ(sut.part, "a::x.value");
}

TEST(Distance, Is_infinite_where_there_is_no_number) {
  EXPECT_TRUE(std::isinf(between(Base::Double, 1.0, std::numeric_limits<double>::quiet_NaN()).largest));
  schema::Variable text = variable(Base::Text, 4);
  text.type.text_size = 4;
  const std::vector<std::uint8_t> a{'a', 0, 'x', 0};
  const std::vector<std::uint8_t> b{'a', 0, 'y', 0};
  const std::vector<std::uint8_t> c{'b', 0, 'x', 0};
  EXPECT_EQ(distance(text, a, b).largest, 0) << "the bytes after the end of a text do not count";
  EXPECT_TRUE(std::isinf(distance(text, a, c).largest));
}

}  // namespace
}  // namespace indurop::node
