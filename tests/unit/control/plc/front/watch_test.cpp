// SPDX-License-Identifier: Apache-2.0
// What a module built with --watch tells about its variables, and how a view writes it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string>

#include "control/plc/front/watch_plan.h"
#include "control/plc/print/live_text.h"
#include "control/plc/print/value_text.h"

namespace indurop::plc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kProgram =
    "TYPE Color : (Red, Green); Point : STRUCT x : INT; y : REAL; END_STRUCT; END_TYPE\n"
    "FUNCTION_BLOCK Motor VAR_INPUT on : BOOL; END_VAR VAR t : TON; n : DINT; END_VAR\n"
    "t(IN := on, PT := T#100ms); n := n + 1; END_FUNCTION_BLOCK\n"
    "PROGRAM main VAR a : ARRAY[1..3] OF INT; m : Motor; p : Point; c : Color; l : ARRAY[0..1] OF Motor; s : "
    "STRING[5];\n"
    "r : POINTER TO INT; END_VAR VAR CONSTANT k : INT := 5; END_VAR VAR_TEMP z : INT; END_VAR\n"
    "m(on := TRUE); a[1] := k; z := 1; p.x := z; c := Green; l[0](on := FALSE); s := 'x'; r := ADR(a[1]); "
    "END_PROGRAM\n";

glb2idl::FileReader reader_of(std::string text) {
  return [text = std::move(text)](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; };
}

CompileOptions options() {
  CompileOptions made;
  made.files = {"in.st"};
  made.name = "sut";
  return made;
}

TEST(PlcWatch, Every_variable_that_stays_has_its_place_also_inside_of_instances) {
  const WatchPlan plan = watch_plan(options(), reader_of(kProgram));
  ASSERT_TRUE(plan.ok);
  ASSERT_EQ(plan.layouts.size(), 1U);
  const WatchLayout& sut = plan.layouts.front();
  std::size_t next = 8;
  for (const WatchedVariable& one : sut.variables) {
    EXPECT_EQ(one.offset, next) << one.path << ": without gaps, after the mark";
    next += packed_size(*one.type);
  }
  EXPECT_LE(next, sut.bytes);
  EXPECT_LT(sut.bytes, next + 256) << "reserves";
  for (const char* path : {"A", "M.ON", "M.T.ET", "M.T.Q", "M.N", "P", "C", "L[0].N", "L[1].T.PT", "S"}) {
    EXPECT_NE(sut.find(path), nullptr) << path;
  }
  for (const char* path : {"K", "Z", "R"}) {
    EXPECT_EQ(sut.find(path), nullptr) << path;
  }
  std::vector<std::string> instances;
  for (const WatchedInstance& one : sut.instances) {
    instances.push_back(one.path);
  }
  EXPECT_THAT(instances, ElementsAre("", "M", "L[0]", "L[1]"));
}

TEST(PlcWatch, Another_program_has_another_mark) {
  std::string other = kProgram;
  other.replace(other.find("n : DINT"), 8, "n : UINT");
  EXPECT_NE(watch_plan(options(), reader_of(kProgram)).layouts.front().mark,
            watch_plan(options(), reader_of(other)).layouts.front().mark);
  // The same variables, but values would be next to the wrong lines.
  EXPECT_NE(watch_plan(options(), reader_of(kProgram)).layouts.front().mark,
            watch_plan(options(), reader_of(kProgram + std::string("\n"))).layouts.front().mark);
}

// A program that changes a little keeps the type of its variable, so it can be exchanged while its node runs.
TEST(PlcWatch, The_variable_has_reserves) {
  const auto bytes_with = [](std::size_t numbers) {
    const std::string text =
        "PROGRAM main VAR a : ARRAY[1.." + std::to_string(numbers) + "] OF BYTE; END_VAR END_PROGRAM\n";
    return watch_plan(options(), reader_of(text)).layouts.front().bytes;
  };
  for (std::size_t numbers = 1; numbers < 16000; numbers = numbers * 5 / 4 + 1) {
    const std::size_t needed = numbers + 8;
    EXPECT_GE(bytes_with(numbers), needed);
    EXPECT_LE(bytes_with(numbers), std::max(needed + 255, needed * 5 / 4)) << numbers;
  }
  std::size_t sizes = 1;
  for (std::size_t numbers = 2; numbers <= 1000; ++numbers) {
    sizes += bytes_with(numbers) != bytes_with(numbers - 1) ? 1U : 0U;
  }
  EXPECT_EQ(sizes, 4U);
}

TEST(PlcWatch, Only_a_module_built_for_it_tells_anything) {
  CompileOptions with = options();
  with.watch = true;
  const Compiled watched = compile(with, reader_of(kProgram));
  ASSERT_TRUE(watched.ok) << base::to_text(watched.diagnostics);
  EXPECT_THAT(watched.glb, HasSubstr("uint8_t main_watch["));
  EXPECT_THAT(watched.modules.front().cpp, HasSubstr("iec::tell<INDUROP_TYPEOF(::sut::main_watch)::tag_type>"));
  const Compiled quiet = compile(options(), reader_of(kProgram));
  EXPECT_THAT(quiet.glb + quiet.modules.front().cpp, Not(HasSubstr("watch")));
}

template <class T>
std::string text_of(const Type& type, const T& value) {
  std::vector<std::uint8_t> bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return value_text(type, bytes);
}

TEST(PlcWatch, Values_are_written_as_in_a_program) {
  TypeTable types;
  const auto type = [&](Elementary one) -> const Type& { return *types.elementary(one); };
  EXPECT_EQ(text_of(type(Elementary::Bool), true), "TRUE");
  EXPECT_EQ(text_of(type(Elementary::Sint), std::int8_t{-5}), "-5");
  EXPECT_EQ(text_of(type(Elementary::Ulint), UINT64_MAX), "18446744073709551615");
  EXPECT_EQ(text_of(type(Elementary::Word), std::uint16_t{0x2a}), "16#002A");
  EXPECT_EQ(text_of(type(Elementary::Real), 1.5F), "1.5");
  EXPECT_EQ(text_of(type(Elementary::Time), std::int64_t{100'000'000}), "T#100ms");
  EXPECT_EQ(text_of(type(Elementary::Date), std::int64_t{0}), "D#1970-01-01");
  EXPECT_EQ(value_text(*types.text(Elementary::String, 3), std::vector<std::uint8_t>{'a', '\'', 0, 'x'}), "'a$''");
  const std::array<char16_t, 8> wide{u'"', u'\u00E4', u'\u20AC', 0xD83D, 0xDE00, 0xD83D, u'\n', 0};
  std::vector<std::uint8_t> bytes(sizeof wide);
  std::memcpy(bytes.data(), &wide, sizeof wide);
  EXPECT_EQ(value_text(*types.text(Elementary::Wstring, 7), bytes), "\"$\"\u00E4\u20AC\U0001F600$D83D$000A\"");
  EXPECT_EQ(text_of(type(Elementary::Char), u8'a'), "'a'");
  EXPECT_EQ(text_of(type(Elementary::Wchar), u'\u00E4'), "\"\u00E4\"");
  Type array;
  array.kind = Type::Kind::Array;
  array.dimensions = {{1, 3}};
  array.element = types.elementary(Elementary::Int);
  EXPECT_EQ(value_text(array, std::vector<std::uint8_t>{5, 0, 6, 0, 255, 255}), "[1..3] 5, 6, -1");
  EXPECT_EQ(value_text(array, std::vector<std::uint8_t>{5}), "?");
  Type color;
  color.kind = Type::Kind::Enum;
  color.items = {{"Red", 0}, {"Green", 1}};
  EXPECT_EQ(value_text(color, std::vector<std::uint8_t>{1, 0}), "Green");
  EXPECT_EQ(value_text(color, std::vector<std::uint8_t>{7, 0}), "7");
}

TEST(PlcWatch, Values_are_next_to_the_lines_that_name_them) {
  const std::map<std::string, std::string> values = {{"SPEED", "5"},     {"T.ET", "T#1s"}, {"A[2].X", "7"},
                                                     {"A", "all of it"}, {"GO", "TRUE"},   {"B[-1,2]", "8"}};
  const auto lines = live_lines(
      "speed := Speed + t.ET; (* n *)\n\nIF a[2].x > 3 THEN m(on := go + a[i + 1]); "
      "END_IF; b[-1, 2] := b[2 - 1, 0];",
      [&values](const std::string& path) {
        const auto found = values.find(path);
        return found == values.end() ? std::string() : found->second;
      });
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].values, "speed = 5   t.ET = T#1s");
  EXPECT_EQ(lines[1].values, "");
  EXPECT_EQ(lines[2].values, "a[2].x = 7   go = TRUE   b[-1,2] = 8");
}

}  // namespace
}  // namespace indurop::plc
