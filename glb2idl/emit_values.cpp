// SPDX-License-Identifier: Apache-2.0
// C++ types and initialisers for the bytes of a type.

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>

#include "glb2idl/emit.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

template <class T>
T read_as(const std::uint8_t* bytes) noexcept {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
std::string integer_text(const std::uint8_t* bytes) {
  return fmt::format("{}", read_as<T>(bytes));
}

std::string real_text(double value, bool is_float) {
  std::string text = is_float ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) {
    text += ".0";
  }
  return text + (is_float ? "F" : "");
}

bool is_zero(const std::uint8_t* bytes, std::uint64_t size) noexcept {
  for (std::uint64_t i = 0; i < size; ++i) {
    if (bytes[i] != 0) {
      return false;
    }
  }
  return true;
}

std::string scalar_text(const schema::Type& type, const std::uint8_t* bytes) {
  switch (type.base) {
    case Base::Bool:
      return bytes[0] != 0 ? "true" : "false";
    case Base::Char:
    case Base::Int8:
      return fmt::format("{}", static_cast<int>(read_as<std::int8_t>(bytes)));
    case Base::UInt8:
      return fmt::format("{}", static_cast<unsigned>(bytes[0]));
    case Base::Int16:
      return integer_text<std::int16_t>(bytes);
    case Base::UInt16:
      return integer_text<std::uint16_t>(bytes);
    case Base::Int32:
      return integer_text<std::int32_t>(bytes);
    case Base::UInt32:
      return integer_text<std::uint32_t>(bytes) + "U";
    case Base::Int64:
      return read_as<std::int64_t>(bytes) == std::numeric_limits<std::int64_t>::min()
                 ? "INT64_MIN"
                 : integer_text<std::int64_t>(bytes);
    case Base::UInt64:
      return integer_text<std::uint64_t>(bytes) + "U";
    case Base::Float:
      return real_text(static_cast<double>(read_as<float>(bytes)), true);
    case Base::Double:
      return real_text(read_as<double>(bytes), false);
    case Base::Text: {
      const auto* text = reinterpret_cast<const char*>(bytes);
      return fmt::format("\"{}\"", escape({text, strnlen(text, type.text_size)}));
    }
    case Base::Enum: {
      const auto value = read_as<std::int32_t>(bytes);
      for (const schema::Enumerator& e : type.enumerators) {
        if (e.value == value) {
          return fmt::format("::{}", qualified(scope_of(type.name), e.name));
        }
      }
      return {};
    }
    case Base::Struct:
      break;
  }
  std::string out;
  for (const schema::Field& field : type.fields) {
    const bool zero = is_zero(bytes + field.offset, field.type.size());
    out += out.empty() ? "" : ", ";
    out += zero ? "{}" : initializer_text(field.type, bytes + field.offset);
  }
  return fmt::format("{{{}}}", out);
}

}  // namespace

std::string initializer_text(const schema::Type& type, const std::uint8_t* bytes) {
  if (type.dims.empty()) {
    return scalar_text(type, bytes);
  }
  schema::Type element = type;
  element.dims.erase(element.dims.begin());
  const std::uint64_t stride = element.size();
  std::uint32_t used = type.dims[0];
  while (used > 0 && is_zero(bytes + (used - 1) * stride, stride)) {
    --used;
  }
  std::string out;
  for (std::uint32_t i = 0; i < used; ++i) {
    out += i == 0 ? "" : ", ";
    out += is_zero(bytes + i * stride, stride) ? "{}" : initializer_text(element, bytes + i * stride);
  }
  return fmt::format("{{{{{}}}}}", out);
}

std::string cpp_type(const schema::Type& type) {
  constexpr std::array<std::string_view, 12> kNames{"bool",           "char",
                                                    "::std::int8_t",  "::std::uint8_t",
                                                    "::std::int16_t", "::std::uint16_t",
                                                    "::std::int32_t", "::std::uint32_t",
                                                    "::std::int64_t", "::std::uint64_t",
                                                    "float",          "double"};
  std::string out = type.base == Base::Text ? fmt::format("::indurop::string<{}>", type.text_size)
                    : type.name.empty()     ? std::string(kNames[static_cast<std::size_t>(type.base)])
                                            : fmt::format("::{}", type.name);
  for (auto dim = type.dims.rbegin(); dim != type.dims.rend(); ++dim) {
    out = fmt::format("::std::array<{}, {}>", out, *dim);
  }
  return out;
}

}  // namespace indurop::glb2idl
