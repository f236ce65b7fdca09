// SPDX-License-Identifier: Apache-2.0
// What a module keeps is shown as its author would write it; the names of the types are those that this compiler gives.

#include "node/replay/kept_text.h"

#include <gtest/gtest.h>
#include <indurop/state.h>

#include <array>
#include <cstring>

namespace indurop::node {
namespace {

template <class T>
std::string shown(const T& value, std::string_view type = detail::type_name<T>()) {
  std::array<std::uint8_t, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  return kept_text(type, bytes);
}

struct Pair {
  std::int32_t a;
  std::int32_t b;
};

TEST(KeptText, Numbers_of_cpp_are_shown_by_the_names_of_the_compiler) {
  EXPECT_EQ(shown(true), "true");
  EXPECT_EQ(shown(std::int8_t{-5}), "-5");
  EXPECT_EQ(shown(std::uint16_t{65535}), "65535");
  EXPECT_EQ(shown(std::int64_t{-1} << 40U), "-1099511627776");
  EXPECT_EQ(shown(std::uint64_t{0} - 1), "18446744073709551615");
  EXPECT_EQ(shown(0.25), "0.25");
  EXPECT_EQ(shown(-1.5F), "-1.5");
}

TEST(KeptText, Arrays_are_listed) {
  EXPECT_EQ(shown(std::array<int, 3>{1, -2, 3}), "[1, -2, 3]");
  const double numbers[2] = {0.5, 2};  // NOLINT(modernize-avoid-c-arrays): as modules declare them
  EXPECT_EQ(shown(numbers), "[0.5, 2]");
  EXPECT_EQ(shown(numbers, "double [2]"), "[0.5, 2]") << "as GCC writes it";
  EXPECT_EQ(shown(numbers, "double[2]"), "[0.5, 2]") << "as Clang writes it";
  EXPECT_EQ(shown(std::array<char, 6>{'a', 'b', 0}, "char[6]"), "\"ab\"");
  EXPECT_EQ(shown(std::array<std::uint16_t, 2>{7, 8}, "ARRAY[1..2] OF UINT"), "[7, 8]");
}

TEST(KeptText, Types_of_plc_programs_are_known) {
  EXPECT_EQ(shown(std::int64_t{1'500'000}, "TIME"), "1.5 ms");
  EXPECT_EQ(shown(std::array<char, 6>{'a', 'b', 0}, "STRING[5]"), "\"ab\"");
  EXPECT_EQ(shown(std::uint8_t{1}, "BOOL"), "true");
  EXPECT_EQ(shown(Pair{1, 2}, "Motor #0123456789abcdef"), "8 bytes: 01 00 00 00 02 00 00 00");
}

TEST(KeptText, What_does_not_fit_its_type_is_shown_as_bytes) {
  EXPECT_EQ(shown(Pair{1, 2}), "8 bytes: 01 00 00 00 02 00 00 00");
  EXPECT_EQ(shown(std::uint8_t{3}, "DINT"), "1 byte: 03");
  EXPECT_EQ(kept_text("char", {}), "0 bytes:");
}

}  // namespace
}  // namespace indurop::node
