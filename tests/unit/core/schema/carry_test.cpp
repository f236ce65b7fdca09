// SPDX-License-Identifier: Apache-2.0
// Kept values of changed types. Random types and values are made twice: as .glb text, and as a tree of which an oracle
// computes what has to remain; it knows no bytes, offsets and layouts.
#include "core/schema/carry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <random>
#include <sstream>

#include "tests/unit/glb2idl/compile_helper.h"

namespace indurop::schema {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream out;
  constexpr int kAllDigits = 17;
  out << std::setprecision(kAllDigits);
  (out << ... << parts);
  return out.str();
}

struct Number {
  const char* name = "";
  int bits = 0;
  bool is_signed = false;
  bool real = false;
};
constexpr std::array<Number, 11> kNumbers{{{"bool", 1, false},
                                           {"int8_t", 8, true},
                                           {"uint8_t", 8, false},
                                           {"int16_t", 16, true},
                                           {"uint16_t", 16, false},
                                           {"int32_t", 32, true},
                                           {"uint32_t", 32, false},
                                           {"int64_t", 64, true},
                                           {"uint64_t", 64, false},
                                           {"float", 32, true, true},
                                           {"double", 64, true, true}}};

struct Shape {
  enum class Kind { Number, Text, Enum, Struct, Array };
  Kind kind = Kind::Number;
  int number = 0;                                      // Number: index in kNumbers
  std::size_t size = 1;                                // Text: bytes; Array: elements
  std::vector<std::string> names;                      // Enum
  std::vector<std::pair<std::string, Shape>> parts{};  // Struct: fields; Array: one, without a name
};

// A value as text; of structs and arrays its parts.
struct Value {
  std::string text;
  std::vector<std::pair<std::string, Value>> parts{};
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int upto(int most) { return std::uniform_int_distribution<int>(0, most)(engine_); }
  bool chance(int percent) { return upto(99) < percent; }

  Shape shape(int depth) {
    Shape made;
    const int choice = upto(depth > 0 ? 6 : 3);
    if (choice <= 2) {
      made.number = upto(10);
    } else if (choice == 3) {
      made.kind = chance(50) ? Shape::Kind::Text : Shape::Kind::Enum;
      made.size = 2U + static_cast<std::size_t>(upto(9));
      for (int i = 0; made.kind == Shape::Kind::Enum && i <= upto(3) + 1; ++i) {
        made.names.push_back(text_of("n", names_, "_", i));
      }
      ++names_;
    } else if (choice == 4) {
      made.kind = Shape::Kind::Array;
      made.size = 1U + static_cast<std::size_t>(upto(4));
      do {
        made.parts = {{"", shape(depth - 1)}};
      } while (made.parts[0].second.kind == Shape::Kind::Array);
    } else {
      made.kind = Shape::Kind::Struct;
      for (int i = 0; i <= upto(3); ++i) {
        made.parts.emplace_back(text_of("f", i), shape(depth - 1));
      }
    }
    return made;
  }

  // As another version of a program declares it.
  Shape changed(const Shape& from) {
    if (chance(6)) {
      return shape(1);
    }
    Shape out = from;
    if (out.kind == Shape::Kind::Number && chance(60)) {
      out.number = upto(10);
    } else if (out.kind == Shape::Kind::Text || out.kind == Shape::Kind::Array) {
      out.size = chance(50) ? 2U + static_cast<std::size_t>(upto(9)) : out.size;
    } else if (out.kind == Shape::Kind::Enum) {
      std::shuffle(out.names.begin(), out.names.end(), engine_);
      if (chance(40) && out.names.size() > 1) {
        out.names.pop_back();
      }
      if (chance(40)) {
        out.names.insert(out.names.begin(), text_of("n", names_++, "_new"));
      }
    }
    for (auto& [name, part] : out.parts) {
      do {
        part = changed(part);
      } while (out.kind == Shape::Kind::Array && part.kind == Shape::Kind::Array);
    }
    if (out.kind == Shape::Kind::Struct) {
      std::shuffle(out.parts.begin(), out.parts.end(), engine_);
      if (chance(30) && out.parts.size() > 1) {
        out.parts.pop_back();
      }
      if (chance(30)) {
        out.parts.emplace_back(text_of("more", names_++), shape(0));
      }
    }
    return out;
  }

  Value value(const Shape& shape) {
    Value out;
    if (shape.kind == Shape::Kind::Number) {
      out.text = number(kNumbers[static_cast<std::size_t>(shape.number)]);
    } else if (shape.kind == Shape::Kind::Text) {
      out.text = std::string("abcdefghij").substr(0, static_cast<std::size_t>(upto(static_cast<int>(shape.size) - 1)));
    } else if (shape.kind == Shape::Kind::Enum) {
      out.text = shape.names[static_cast<std::size_t>(upto(static_cast<int>(shape.names.size()) - 1))];
    }
    for (const auto& [name, part] : shape.parts) {
      for (std::size_t i = 0; i < (shape.kind == Shape::Kind::Array ? shape.size : 1); ++i) {
        out.parts.emplace_back(name, value(part));
      }
    }
    return out;
  }

 private:
  std::string number(const Number& of) {
    if (of.real) {
      return std::array{"0", "-3", "100", "0.5", "70000", "3000000000"}[static_cast<std::size_t>(upto(5))];
    }
    if (of.bits == 1) {
      return chance(50) ? "true" : "false";
    }
    const auto bits = static_cast<unsigned>(std::min(of.bits, 40) - (of.is_signed ? 1 : 0));
    auto most = static_cast<long long>((1ULL << bits) - 1);
    most = chance(40) ? std::min(most, 100LL) : most;
    return std::to_string(std::uniform_int_distribution<long long>(of.is_signed ? -most : 0, most)(engine_));
  }

  std::mt19937 engine_;
  int names_ = 0;
};

// "uint8_t x[3]", and before it what it needs.
std::string declared(const Shape& shape, const std::string& name, std::string& before, int& types) {
  switch (shape.kind) {
    case Shape::Kind::Number:
      return text_of(kNumbers[static_cast<std::size_t>(shape.number)].name, " ", name);
    case Shape::Kind::Text:
      return text_of("char ", name, "[", shape.size, "]");
    case Shape::Kind::Array: {
      const Shape& element = shape.parts[0].second;
      const std::string inner = element.kind == Shape::Kind::Text ? "@@" : name;
      std::string text = declared(element, inner, before, types);
      if (element.kind == Shape::Kind::Text) {
        return text_of("char ", name, "[", shape.size, "][", element.size, "]");
      }
      return text_of(text, "[", shape.size, "]");
    }
    case Shape::Kind::Enum: {
      std::string items;
      for (const std::string& one : shape.names) {
        items += (items.empty() ? "" : ", ") + one;
      }
      before += text_of("enum E", types, " { ", items, " };\n");
      return text_of("E", types++, " ", name);
    }
    case Shape::Kind::Struct:
      break;
  }
  std::string fields;
  for (const auto& [field, part] : shape.parts) {
    fields += declared(part, field, before, types) + "; ";
  }
  before += text_of("struct S", types, " { ", fields, "};\n");
  return text_of("S", types++, " ", name);
}

Type type_of(const Shape& shape) {
  std::string before;
  int types = 0;
  const std::string variable = declared(shape, "x", before, types);
  return glb2idl::test::variable(glb2idl::test::compile_text("namespace a;\n" + before + variable + ";\n"), "a::x")
      .type;
}

std::string shown(const Shape& shape, const Value& value) {
  if (shape.kind == Shape::Kind::Text) {
    return '"' + value.text + '"';
  }
  if (value.parts.empty()) {
    return value.text;
  }
  std::string out;
  for (const auto& [name, part] : value.parts) {
    std::size_t i = 0;
    while (shape.kind == Shape::Kind::Struct && shape.parts[i].first != name) {
      ++i;
    }
    out += (out.empty() ? "" : ", ") + (name.empty() ? "" : name + ": ") + shown(shape.parts[i].second, part);
  }
  return shape.kind == Shape::Kind::Array ? "[" + out + "]" : "{" + out + "}";
}

// The oracle: `now` is what the new variable begins with.
class Oracle {
 public:
  bool lost = false;

  Value carried(const Shape& from, const Value& old, const Shape& to, const Value& now) {
    if (from.kind != to.kind) {
      lost = true;
      return now;
    }
    switch (from.kind) {
      case Shape::Kind::Number:
        return number(old, kNumbers[static_cast<std::size_t>(to.number)], now);
      case Shape::Kind::Text:
        lost = lost || old.text.size() > to.size - 1;
        return {old.text.substr(0, to.size - 1), {}};
      case Shape::Kind::Enum: {
        const bool known = std::find(to.names.begin(), to.names.end(), old.text) != to.names.end();
        lost = lost || !known;
        return known ? old : now;
      }
      default:
        return parts(from, old, to, now);
    }
  }

 private:
  Value parts(const Shape& from, const Value& old, const Shape& to, const Value& now) {
    Value out = now;
    const bool array = from.kind == Shape::Kind::Array;
    lost = lost || (array && from.size != to.size);
    for (std::size_t i = 0; i < old.parts.size(); ++i) {
      std::size_t k = i;
      if (!array) {
        for (k = 0; k < to.parts.size() && to.parts[k].first != from.parts[i].first;) {
          ++k;
        }
      }
      if (k >= out.parts.size()) {
        lost = true;
        continue;
      }
      out.parts[k].second = carried(from.parts[array ? 0 : i].second, old.parts[i].second,
                                    to.parts[array ? 0 : k].second, now.parts[k].second);
    }
    return out;
  }

  Value number(const Value& old, const Number& to, const Value& now) {
    const long double value = old.text == "true" ? 1 : old.text == "false" ? 0 : std::stold(old.text);
    if (to.real) {
      const long double kept = to.bits == 32 ? static_cast<long double>(static_cast<float>(value)) : value;
      lost = lost || (kept != value);  // only whole numbers are rounded here
      return {text_of(static_cast<double>(kept)), {}};
    }
    const int bits = to.bits - (to.is_signed ? 1 : 0);
    const long double most = std::ldexp(1.0L, bits) - 1;
    const long double least = to.is_signed ? -most - 1 : 0;
    if (value != std::floor(value) || value < least || value > most) {
      lost = true;
      return now;
    }
    return {to.bits == 1 ? (value != 0 ? "true" : "false") : text_of(static_cast<long long>(value)), {}};
  }
};

std::vector<std::uint8_t> bytes_of(const Type& type, const std::string& text) {
  std::vector<std::uint8_t> bytes(type.size());
  const auto parsed = parse_value(type, text, bytes);
  EXPECT_TRUE(parsed.ok()) << text << ": " << parsed.error().message << " " << display_name(type);
  return bytes;
}

TEST(Carry, Of_random_changes_remains_what_an_oracle_says) {
  int lossless = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Shape before = random.shape(2);
    const Shape after = random.changed(before);
    const Value old = random.value(before);
    const Value initial = random.value(after);
    const Type from = type_of(before);
    const Type to = type_of(after);
    std::vector<std::uint8_t> sut = bytes_of(to, shown(after, initial));
    const auto lost = carry_value("x", {from, ""}, bytes_of(from, shown(before, old)), {to, ""}, sut);
    Oracle oracle;
    const Value expected = oracle.carried(before, old, after, initial);
    ASSERT_EQ(format_value(to, sut), format_value(to, bytes_of(to, shown(after, expected))))
        << shown(before, old) << " as " << display_name(from) << " to " << display_name(to);
    ASSERT_EQ(!lost.empty(), oracle.lost)
        << shown(before, old) << " becomes " << shown(after, expected) << (lost.empty() ? "" : lost[0]);
    lossless += oracle.lost ? 0 : 1;
  }
  EXPECT_GT(lossless, 500);
}

std::vector<std::string> carry(const std::string& from, const std::string& old, const std::string& to,
                               std::string& value, const char* unit = "") {
  const auto type = [](const std::string& text) {
    return glb2idl::test::variable(glb2idl::test::compile_text("namespace a;\n" + text + ";\n"), "a::x").type;
  };
  const Type before = type(from);
  const Type after = type(to);
  std::vector<std::uint8_t> bytes(after.size());
  auto lost = carry_value("x", {before, ""}, bytes_of(before, old), {after, unit}, bytes);
  value = format_value(after, bytes);
  return lost;
}

TEST(Carry, Says_what_is_lost) {
  std::string value;
  EXPECT_THAT(carry("int32_t x", "70000", "int16_t x", value),
              ElementsAre("x: 70000 is no value of int16_t, starts with its initial value"));
  EXPECT_EQ(value, "0");
  EXPECT_THAT(carry("int32_t x[3]", "[1, 2, 3]", "int64_t x[2]", value),
              ElementsAre("x: had 3 elements, has 2; 2 are kept from the first on"));
  EXPECT_EQ(value, "[1, 2]");
  EXPECT_THAT(carry("char x[8]", "\"motor 1\"", "char x[6]", value), ElementsAre("x: had 7 characters, 5 are kept"));
  EXPECT_EQ(value, "\"motor\"");
  EXPECT_THAT(carry("struct S { int32_t a; int32_t b; };\nS x", "{a: 1, b: 2}", "struct S { int32_t b; };\nS x", value),
              ElementsAre("x.a: is no longer declared"));
  EXPECT_EQ(value, "{b: 2}");
  EXPECT_THAT(carry("int32_t x", "16777217", "float x", value),
              ElementsAre(HasSubstr("x: was 16777217, is 16777216 rounded to float")));
  EXPECT_THAT(carry("int32_t x[20]", "[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 300, 300, 300, 300, 300, 300, 300, 300, 300, 300]",
                    "uint8_t x[20]", value),
              ::testing::SizeIs(9))
      << "eight lines, and how many more";
}

TEST(Carry, A_number_of_another_unit_is_another_value) {
  std::string value;
  EXPECT_THAT(carry("int64_t x", "5", "int64_t x", value, "ns"),
              ElementsAre("x: its unit was '', is 'ns', starts with its initial value"));
  EXPECT_EQ(value, "0");
}

TEST(Carry, Equal_types_lose_nothing) {
  std::string value;
  EXPECT_THAT(carry("double x[2]", "[nan, -inf]", "double x[2]", value), IsEmpty());
  EXPECT_EQ(value, "[nan, -inf]");
  EXPECT_THAT(carry("float x", "inf", "double x", value), IsEmpty());
  EXPECT_EQ(value, "inf");
}

}  // namespace
}  // namespace indurop::schema
