// SPDX-License-Identifier: Apache-2.0
#include "node/replay/kept_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

#include "core/base/duration.h"
#include "core/schema/schema.h"

namespace indurop::node {
namespace {

using schema::Base;

constexpr std::size_t kMostElements = 64;
constexpr std::size_t kMostBytes = 32;

// As GCC and Clang write types of C++, and as IEC 61131-3 names its own.
constexpr std::array kNumbers{
    std::pair<std::string_view, Base>{"bool", Base::Bool},
    std::pair<std::string_view, Base>{"char", Base::Char},
    std::pair<std::string_view, Base>{"signed char", Base::Int8},
    std::pair<std::string_view, Base>{"unsigned char", Base::UInt8},
    std::pair<std::string_view, Base>{"short", Base::Int16},
    std::pair<std::string_view, Base>{"short int", Base::Int16},
    std::pair<std::string_view, Base>{"unsigned short", Base::UInt16},
    std::pair<std::string_view, Base>{"short unsigned int", Base::UInt16},
    std::pair<std::string_view, Base>{"int", Base::Int32},
    std::pair<std::string_view, Base>{"unsigned int", Base::UInt32},
    std::pair<std::string_view, Base>{"long", Base::Int64},
    std::pair<std::string_view, Base>{"long int", Base::Int64},
    std::pair<std::string_view, Base>{"long long int", Base::Int64},
    std::pair<std::string_view, Base>{"unsigned long", Base::UInt64},
    std::pair<std::string_view, Base>{"long unsigned int", Base::UInt64},
    std::pair<std::string_view, Base>{"long long unsigned int", Base::UInt64},
    std::pair<std::string_view, Base>{"float", Base::Float},
    std::pair<std::string_view, Base>{"double", Base::Double},
    std::pair<std::string_view, Base>{"BOOL", Base::Bool},
    std::pair<std::string_view, Base>{"SINT", Base::Int8},
    std::pair<std::string_view, Base>{"INT", Base::Int16},
    std::pair<std::string_view, Base>{"DINT", Base::Int32},
    std::pair<std::string_view, Base>{"LINT", Base::Int64},
    std::pair<std::string_view, Base>{"USINT", Base::UInt8},
    std::pair<std::string_view, Base>{"UINT", Base::UInt16},
    std::pair<std::string_view, Base>{"UDINT", Base::UInt32},
    std::pair<std::string_view, Base>{"ULINT", Base::UInt64},
    std::pair<std::string_view, Base>{"REAL", Base::Float},
    std::pair<std::string_view, Base>{"LREAL", Base::Double},
    std::pair<std::string_view, Base>{"BYTE", Base::UInt8},
    std::pair<std::string_view, Base>{"WORD", Base::UInt16},
    std::pair<std::string_view, Base>{"DWORD", Base::UInt32},
    std::pair<std::string_view, Base>{"LWORD", Base::UInt64},
};

std::string as_bytes(std::span<const std::uint8_t> bytes) {
  std::string text = fmt::format("{} byte{}:", bytes.size(), bytes.size() == 1 ? "" : "s");
  for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), kMostBytes))) {
    text += fmt::format(" {:02x}", byte);
  }
  return text + (bytes.size() > kMostBytes ? " ..." : "");
}

std::optional<std::string> number_text(std::string_view type, std::span<const std::uint8_t> bytes) {
  const auto* const found =
      std::find_if(kNumbers.begin(), kNumbers.end(), [type](const auto& one) { return one.first == type; });
  if (found == kNumbers.end()) {
    return std::nullopt;
  }
  schema::Type number;
  number.base = found->second;
  number.element_size = number.align = schema::size_of(number.base);
  return number.size() == bytes.size() ? std::optional(schema::format_value(number, bytes)) : std::nullopt;
}

std::optional<std::string> special_text(std::string_view type, std::span<const std::uint8_t> bytes) {
  if ((type == "TIME" || type == "LTIME") && bytes.size() == sizeof(std::int64_t)) {
    std::int64_t ns = 0;
    std::memcpy(&ns, bytes.data(), sizeof ns);
    return base::format_duration(base::Nanos(ns));
  }
  if (type.starts_with("STRING[") || type.starts_with("char [") || type.starts_with("char[")) {
    const auto* const begin = reinterpret_cast<const char*>(bytes.data());
    return fmt::format("\"{}\"", std::string_view(begin, ::strnlen(begin, bytes.size())));
  }
  return std::nullopt;
}

// Returns the type of an element, if `type` is an array with one dimension: "int [4]" (GCC), "int[4]" (Clang),
// "std::array<int, 4>", "ARRAY[0..3] OF INT". Of several dimensions, the elements are listed one after the other.
std::optional<std::string_view> element_of(std::string_view type) {
  constexpr std::string_view kStandard = "std::array<";
  if (type.starts_with("ARRAY[")) {
    const std::size_t of = type.find("] OF ");
    return of == std::string_view::npos ? std::nullopt : std::optional(type.substr(of + 5));
  }
  if (type.starts_with(kStandard) && type.ends_with('>')) {
    const std::size_t comma = type.rfind(',');
    return comma == std::string_view::npos ? std::nullopt
                                           : std::optional(type.substr(kStandard.size(), comma - kStandard.size()));
  }
  const std::size_t bracket = type.find('[');
  if (!type.ends_with(']') || bracket == std::string_view::npos) {
    return std::nullopt;
  }
  return type.substr(0, bracket > 0 && type[bracket - 1] == ' ' ? bracket - 1 : bracket);
}

std::optional<std::size_t> size_of_type(std::string_view type) {
  const auto* const found =
      std::find_if(kNumbers.begin(), kNumbers.end(), [type](const auto& one) { return one.first == type; });
  if (found != kNumbers.end()) {
    return schema::size_of(found->second);
  }
  return type == "TIME" || type == "LTIME" ? std::optional(sizeof(std::int64_t)) : std::nullopt;
}

std::optional<std::string> array_text(std::string_view type, std::span<const std::uint8_t> bytes) {
  auto element = element_of(type);
  while (element && !size_of_type(*element)) {
    element = element_of(*element);
  }
  const std::size_t size = element ? *size_of_type(*element) : 0;
  if (size == 0 || bytes.size() % size != 0) {
    return std::nullopt;
  }
  std::string text = "[";
  const std::size_t count = bytes.size() / size;
  for (std::size_t i = 0; i < std::min(count, kMostElements); ++i) {
    text += (i == 0 ? "" : ", ") + kept_text(*element, bytes.subspan(i * size, size));
  }
  return text + (count > kMostElements ? ", ...]" : "]");
}

}  // namespace

std::string kept_text(std::string_view type, std::span<const std::uint8_t> bytes) {
  type = type.substr(0, type.find(" #"));  // the hash of a layout
  if (auto text = number_text(type, bytes)) {
    return *std::move(text);
  }
  if (auto text = special_text(type, bytes)) {
    return *std::move(text);
  }
  auto text = array_text(type, bytes);
  return text ? *std::move(text) : as_bytes(bytes);
}

}  // namespace indurop::node
