// SPDX-License-Identifier: Apache-2.0
// Modules in C see the variables that modules in C++ see: the header for C++ is the yardstick.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <indurop/generated.h>
#include "hosted.h"

// NOLINTBEGIN(cppcoreguidelines-macro-usage,readability-identifier-naming): one line for each variable, names as in C
#define FOR_EACH(use)                                                                                           \
  use(flag) use(letter) use(i8) use(u8) use(i16) use(u16) use(i32) use(u32) use(i64) use(u64) use(f32) use(f64) \
      use(mode) use(part) use(parts) use(vector) use(label) use(labels)

extern "C" {
#define DECLARE(name)           \
  void c_read_##name(void* to); \
  void c_write_##name(const void*);
FOR_EACH(DECLARE)
double c_get_x(int i);
void c_set_cell(int i, int row, int column, std::uint16_t value);
void c_double_all();
std::int64_t c_age_ns();
bool c_is_valid();
int c_print(const char* text);
std::int64_t c_property(const char* name);
const char* c_property_text(const char* name);
extern const std::size_t c_ref_layout[9];
}
// NOLINTEND(cppcoreguidelines-macro-usage,readability-identifier-naming)

namespace {

namespace sides = both::sides;
using indurop::testing::Hosted;
using indurop::testing::TestNode;

std::mt19937_64& random_bits() {
  static std::mt19937_64 bits(42);
  return bits;
}

// A random value without padding bytes that a copy of its members would leave out, and with texts that end.
template <class Value>
Value random_value() {
  Value value{};
  if constexpr (std::is_same_v<Value, bool>) {
    value = random_bits()() % 2 == 0;
  } else if constexpr (std::is_same_v<Value, sides::Mode>) {
    value = static_cast<sides::Mode>(random_bits()() % 3);
  } else if constexpr (std::is_same_v<Value, sides::Part>) {
    value.x = static_cast<double>(static_cast<std::int64_t>(random_bits()()));
    value.small = static_cast<std::int8_t>(random_bits()());
    value.label = std::to_string(random_bits()()).c_str();
    value.mode = random_value<sides::Mode>();
    value.grid = random_value<decltype(value.grid)>();
  } else if constexpr (std::is_integral_v<Value>) {
    value = static_cast<Value>(random_bits()());
  } else if constexpr (std::is_floating_point_v<Value>) {
    value = static_cast<Value>(static_cast<std::int64_t>(random_bits()()));
  } else if constexpr (requires { value.c_str(); }) {
    value = std::to_string(random_bits()()).c_str();
  } else {
    for (auto& element : value) {
      element = random_value<std::remove_reference_t<decltype(element)>>();
    }
  }
  return value;
}

template <class Variable>
void expect_equal_sides(const char* name, const Variable& variable, void (*read)(void*), void (*write)(const void*)) {
  using Value = std::remove_cvref_t<decltype(variable.get())>;
  Value seen{};
  read(&seen);
  EXPECT_EQ(seen, variable.get()) << name << ": initial value";
  for (int i = 0; i < 100; ++i) {
    const auto from_cpp = random_value<Value>();
    variable = from_cpp;
    read(&seen);
    EXPECT_EQ(seen, from_cpp) << name;
    const auto from_c = random_value<Value>();
    write(&from_c);
    EXPECT_EQ(variable.get(), from_c) << name;
  }
}

TEST(CModule, Reads_and_writes_what_a_module_in_cpp_does) {
  TestNode node;
  const Hosted hosted(node);
  ASSERT_TRUE(hosted.problems.empty());
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage)
#define COMPARE(name) expect_equal_sides(#name, sides::name, c_read_##name, c_write_##name);
  FOR_EACH(COMPARE)
}

TEST(CModule, Has_initial_values_without_a_node){
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage)
#define COMPARE_INITIAL(name)                              \
  {                                                        \
    std::remove_cvref_t<decltype(sides::name.get())> seen; \
    c_read_##name(&seen);                                  \
    EXPECT_EQ(seen, sides::name.get()) << #name;           \
  }
    FOR_EACH(COMPARE_INITIAL)}

TEST(CModule, Uses_parts) {
  TestNode node;
  const Hosted hosted(node);
  for (unsigned i = 0; i < 4; ++i) {
    sides::parts[i].x = 1.5 * i;
    EXPECT_EQ(c_get_x(static_cast<int>(i)), 1.5 * i);
    c_set_cell(static_cast<int>(i), 1, 2, static_cast<std::uint16_t>(100 + i));
    EXPECT_EQ(sides::parts[i].grid[1][2], 100 + i);
    EXPECT_EQ(sides::parts[i].grid[1][1], 0);
    EXPECT_EQ(sides::parts[i].x, 1.5 * i);
  }
  sides::u32 = 21;
  c_double_all();
  EXPECT_EQ(sides::u32, 42U);
  EXPECT_EQ(sides::f64, 5.0);
  EXPECT_EQ(sides::part.x, 2.5);
  EXPECT_EQ(sides::part.mode, sides::Off);
  EXPECT_EQ(sides::part.grid[1][0], 4);
}

TEST(CModule, Names_an_index_that_is_too_large) {
  TestNode node;
  const Hosted hosted(node);
  for (const int index : {4, 1000, -1}) {
    try {
      c_get_x(index);
      FAIL() << index;
    } catch (const std::out_of_range& fault) {
      EXPECT_NE(std::string(fault.what()).find("both::sides::parts"), std::string::npos) << fault.what();
    }
    EXPECT_THROW(c_set_cell(index, 0, 0, 1), std::out_of_range);
  }
}

TEST(CModule, Does_not_change_what_is_forced) {
  TestNode node;
  const Hosted hosted(node);
  const auto& store = node.store();
  const auto* entry = store.find(indurop::abi::fnv1a64("both::sides::f64", 16));
  ASSERT_NE(entry, nullptr);
  std::array<std::uint8_t, 8> held{};
  const double value = 7.5;
  std::memcpy(held.data(), &value, sizeof value);
  ASSERT_TRUE(node.store().force(*entry, 0, held, indurop::vars::kForever).ok());
  c_double_all();
  EXPECT_EQ(sides::f64, 7.5);
}

TEST(CModule, Values_of_this_board_are_valid) {
  EXPECT_EQ(c_age_ns(), 0);
  EXPECT_TRUE(c_is_valid());
}

TEST(CModule, Prints_as_c_does) {
  TestNode node;
  const Hosted hosted(node);
  char expected[200];
  std::snprintf(expected, sizeof expected, "%d %5.2f|%-6s|%#x %llu %c %hhd %.3s %*d%%\n", -4, 3.14159, "abcd", 255U,
                1ULL << 40, 'z', static_cast<signed char>(7), "abcd", 4, 9);
  EXPECT_EQ(c_print("abcd"), static_cast<int>(std::strlen(expected)));
  EXPECT_EQ(indurop::testing::printed(node), expected);
}

TEST(CModule, Has_properties) {
  TestNode node({{"m", {}, 1'000'000, {{"number", "-12"}, {"text", "left"}}, ""}});
  const Hosted hosted(node);
  EXPECT_EQ(c_property("number"), -12);
  EXPECT_EQ(c_property("other"), -1);
  EXPECT_STREQ(c_property_text("text"), "left");
  EXPECT_STREQ(c_property_text("other"), "none");
}

TEST(CModule, Its_rows_have_the_layout_of_cpp) {
  using indurop::abi::Ref;
  const std::array<std::size_t, 9> expected{sizeof(Ref),          offsetof(Ref, name_hash), offsetof(Ref, type_hash),
                                            offsetof(Ref, entry), offsetof(Ref, initial),   offsetof(Ref, value_size),
                                            offsetof(Ref, kind),  offsetof(Ref, name),      INDUROP_ABI_VERSION};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), c_ref_layout));
}

}  // namespace
