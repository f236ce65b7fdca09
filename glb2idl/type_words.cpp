// SPDX-License-Identifier: Apache-2.0
// Tables of built-in type names.

#include "glb2idl/type_words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace indurop::glb2idl {
namespace {

using schema::Base;
using Fixed = std::pair<std::string_view, Base>;
using Substitute = std::pair<std::string_view, std::string_view>;

constexpr std::array<Fixed, 16> kFixed{{{"int8_t", Base::Int8},
                                        {"uint8_t", Base::UInt8},
                                        {"int16_t", Base::Int16},
                                        {"uint16_t", Base::UInt16},
                                        {"int32_t", Base::Int32},
                                        {"uint32_t", Base::UInt32},
                                        {"int64_t", Base::Int64},
                                        {"uint64_t", Base::UInt64},
                                        {"int8", Base::Int8},
                                        {"uint8", Base::UInt8},
                                        {"int16", Base::Int16},
                                        {"uint16", Base::UInt16},
                                        {"int32", Base::Int32},
                                        {"uint32", Base::UInt32},
                                        {"int64", Base::Int64},
                                        {"uint64", Base::UInt64}}};

constexpr std::array<std::string_view, 10> kWords{"char",     "short", "int",    "long", "signed",
                                                  "unsigned", "float", "double", "bool", "void"};

constexpr std::array<Substitute, 24> kSubstitutes{{{"string", "char name[32]"},
                                                   {"std", "the plain type, such as int32_t"},
                                                   {"byte", "uint8_t"},
                                                   {"octet", "uint8_t"},
                                                   {"BYTE", "uint8_t"},
                                                   {"WORD", "uint16_t"},
                                                   {"DWORD", "uint32_t"},
                                                   {"LWORD", "uint64_t"},
                                                   {"SINT", "int8_t"},
                                                   {"INT", "int16_t"},
                                                   {"DINT", "int32_t"},
                                                   {"LINT", "int64_t"},
                                                   {"UINT", "uint16_t"},
                                                   {"UDINT", "uint32_t"},
                                                   {"REAL", "float"},
                                                   {"LREAL", "double"},
                                                   {"BOOL", "bool"},
                                                   {"boolean", "bool"},
                                                   {"_Bool", "bool"},
                                                   {"float32", "float"},
                                                   {"float64", "double"},
                                                   {"size_t", "uint64_t"},
                                                   {"wchar_t", "char name[32] with UTF-8"},
                                                   {"uint", "uint32_t"}}};

// Number of occurrences of each word of kWords.
using Counts = std::array<int, kWords.size()>;
enum Word : std::size_t { Char, Short, Int, Long, Signed, Unsigned, Float, Double, Bool, Void };

std::optional<Base> integer(const Counts& n) noexcept {
  const bool is_unsigned = n[Unsigned] != 0;
  if (n[Signed] + n[Unsigned] > 1 || n[Int] > 1 || n[Short] > 1 || n[Long] > 2 || n[Short] * n[Long] != 0) {
    return std::nullopt;
  }
  if (n[Short] != 0) {
    return is_unsigned ? Base::UInt16 : Base::Int16;
  }
  if (n[Long] != 0) {
    return is_unsigned ? Base::UInt64 : Base::Int64;
  }
  return is_unsigned ? Base::UInt32 : Base::Int32;
}

}  // namespace

bool is_type_word(std::string_view word) noexcept {
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end() || fixed_type(word);
}

std::optional<Base> fixed_type(std::string_view word) noexcept {
  const auto* const found = std::find_if(kFixed.begin(), kFixed.end(), [&](const Fixed& f) { return f.first == word; });
  return found == kFixed.end() ? std::nullopt : std::optional<Base>(found->second);
}

std::optional<Base> combined_type(std::span<const std::string_view> words) noexcept {
  Counts n{};
  for (const std::string_view word : words) {
    const auto* const found = std::find(kWords.begin(), kWords.end(), word);
    if (found == kWords.end()) {
      return std::nullopt;
    }
    ++n[static_cast<std::size_t>(found - kWords.begin())];
  }
  const auto only = [&](Word word) { return n[word] == 1 && words.size() == 1; };
  if (only(Float)) {
    return Base::Float;
  }
  if (only(Double)) {
    return Base::Double;
  }
  if (only(Bool)) {
    return Base::Bool;
  }
  if (n[Float] + n[Double] + n[Bool] + n[Void] != 0) {
    return std::nullopt;
  }
  if (n[Char] == 0) {
    return integer(n);
  }
  if (n[Char] > 1 || n[Short] + n[Int] + n[Long] != 0 || n[Signed] + n[Unsigned] > 1) {
    return std::nullopt;
  }
  return n[Unsigned] != 0 ? Base::UInt8 : n[Signed] != 0 ? Base::Int8 : Base::Char;
}

std::string_view substitute_for(std::string_view word) noexcept {
  const auto* const found =
      std::find_if(kSubstitutes.begin(), kSubstitutes.end(), [&](const Substitute& s) { return s.first == word; });
  return found == kSubstitutes.end() ? std::string_view() : found->second;
}

const std::vector<std::string>& type_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> all(kWords.begin(), kWords.end() - 1);
    for (const Fixed& f : kFixed) {
      all.emplace_back(f.first);
    }
    return all;
  }();
  return kNames;
}

}  // namespace indurop::glb2idl
