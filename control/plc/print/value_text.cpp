// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "control/plc/emit/watch_layout.h"
#include "control/plc/model/characters.h"
#include "control/plc/print/expression_text.h"

namespace indurop::plc {
namespace {

constexpr std::size_t kMostElements = 8;

template <class T>
T take(std::span<const std::uint8_t> bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::int64_t whole_number(Elementary type, std::span<const std::uint8_t> bytes) {
  const bool has_sign = is_signed_int(type);
  switch (bits_of(type)) {
    case 16:
      return has_sign ? std::int64_t{take<std::int16_t>(bytes)} : std::int64_t{take<std::uint16_t>(bytes)};
    case 32:
      return has_sign ? std::int64_t{take<std::int32_t>(bytes)} : std::int64_t{take<std::uint32_t>(bytes)};
    case 64:
      return take<std::int64_t>(bytes);
    default:
      return has_sign ? std::int64_t{take<std::int8_t>(bytes)} : std::int64_t{take<std::uint8_t>(bytes)};
  }
}

// Returns the text up to its end, in UTF-8.
std::string wide_text(std::span<const std::uint8_t> bytes) {
  std::u16string wide;
  for (; bytes.size() >= sizeof(char16_t); bytes = bytes.subspan(sizeof(char16_t))) {
    wide += take<char16_t>(bytes);
  }
  wide.resize(std::min(wide.find(u'\0'), wide.size()));
  return to_utf8(wide);
}

std::string elementary_text(const Type& type, std::span<const std::uint8_t> bytes) {
  const Elementary of = type.elementary;
  if (of == Elementary::Bool) {
    return bytes[0] != 0 ? "TRUE" : "FALSE";
  }
  if (of == Elementary::String) {
    return quoted_text(std::string(bytes.begin(), std::find(bytes.begin(), bytes.end(), std::uint8_t{0})));
  }
  if (of == Elementary::Wstring) {
    return wide_quoted_text(wide_text(bytes));
  }
  if (is_character(of)) {
    const auto code = static_cast<std::uint16_t>(whole_number(of, bytes));
    const std::array<std::uint8_t, 2> one{static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8U)};
    return of == Elementary::Char ? quoted_text(std::string(1, static_cast<char>(code)))
                                  : wide_quoted_text(wide_text(one));
  }
  if (of == Elementary::Real || of == Elementary::Lreal) {
    return of == Elementary::Real ? fmt::format("{:.7g}", take<float>(bytes))
                                  : fmt::format("{:.15g}", take<double>(bytes));
  }
  if (of == Elementary::Time || is_date(of)) {
    return time_text(take<std::int64_t>(bytes), of);
  }
  const std::int64_t number = whole_number(of, bytes);
  if (is_bit(of)) {
    return fmt::format("16#{:0{}X}", static_cast<std::uint64_t>(number), bits_of(of) / 4);
  }
  return of == Elementary::Ulint ? fmt::format("{}", static_cast<std::uint64_t>(number)) : fmt::format("{}", number);
}

std::string enum_text(const Type& type, std::span<const std::uint8_t> bytes) {
  const std::int64_t number = whole_number(type.elementary, bytes);
  const auto item =
      std::find_if(type.items.begin(), type.items.end(), [&](const EnumItem& one) { return one.value == number; });
  return item == type.items.end() ? fmt::format("{}", number) : item->name;
}

std::string array_text(const Type& type, std::span<const std::uint8_t> bytes) {
  std::string text = "[";
  for (const Bounds& one : type.dimensions) {
    text += fmt::format("{}{}..{}", text.size() > 1 ? ", " : "", one.low, one.high);
  }
  text += "]";
  const std::size_t size = packed_size(*type.element);
  const std::size_t count = size == 0 ? 0 : bytes.size() / size;
  for (std::size_t i = 0; i < std::min(count, kMostElements); ++i) {
    text += (i == 0 ? " " : ", ") + value_text(*type.element, bytes.subspan(i * size, size));
  }
  return text + (count > kMostElements ? ", ..." : "");
}

std::string struct_text(const Type& type, std::span<const std::uint8_t> bytes) {
  std::string text = "(";
  std::size_t offset = 0;
  for (const Field& one : type.fields) {
    const std::size_t size = packed_size(*one.type);
    text += fmt::format("{}{} := {}", offset == 0 ? "" : ", ", one.name,
                        value_text(*one.type, bytes.subspan(offset, size)));
    offset += size;
  }
  return text + ")";
}

}  // namespace

std::string value_text(const Type& type, std::span<const std::uint8_t> bytes) {
  const std::size_t size = packed_size(type);
  if (bytes.size() < size) {
    return "?";
  }
  bytes = bytes.first(size);
  switch (type.kind) {
    case Type::Kind::Elementary:
      return elementary_text(type, bytes);
    case Type::Kind::Enum:
      return enum_text(type, bytes);
    case Type::Kind::Array:
      return array_text(type, bytes);
    case Type::Kind::Struct:
      return struct_text(type, bytes);
    case Type::Kind::Block:
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      break;
  }
  return "?";
}

}  // namespace indurop::plc
