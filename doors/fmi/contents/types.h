// SPDX-License-Identifier: Apache-2.0
// Which types of FMI 2 and FMI 3 the types of shared variables have: for the model description and for the functions.

#pragma once

#include <cstdint>

#include "core/schema/schema.h"

namespace indurop::fmi {

template <class... Bases>
constexpr std::uint32_t set_of(Bases... bases) {
  return ((1U << static_cast<unsigned int>(bases)) | ...);
}
constexpr bool contains(std::uint32_t set, schema::Base base) {
  return (set & set_of(base)) != 0;
}

// FMI 2 has only int and double: what an int cannot hold is a Real.
inline constexpr std::uint32_t kReals =
    set_of(schema::Base::Double, schema::Base::Float, schema::Base::Int64, schema::Base::UInt64, schema::Base::UInt32);
inline constexpr std::uint32_t kIntegers =
    set_of(schema::Base::Int8, schema::Base::UInt8, schema::Base::Int16, schema::Base::UInt16, schema::Base::Int32,
           schema::Base::Char, schema::Base::Enum);
inline constexpr std::uint32_t kBooleans = set_of(schema::Base::Bool);
inline constexpr std::uint32_t kTexts = set_of(schema::Base::Text);
inline constexpr std::uint32_t kEnumerations = set_of(schema::Base::Enum);

// In FMI 3 a character is a UInt8, and the functions of Int64 read and write enumerations.
inline constexpr std::uint32_t kUInt8s = set_of(schema::Base::UInt8, schema::Base::Char);
inline constexpr std::uint32_t kInt64s = set_of(schema::Base::Int64, schema::Base::Enum);

// Names of the elements in a model description. Structs have none.
constexpr const char* fmi2_element(schema::Base base) {
  if (contains(kEnumerations, base)) {
    return "Enumeration";
  }
  if (contains(kReals, base)) {
    return "Real";
  }
  if (contains(kIntegers, base)) {
    return "Integer";
  }
  return contains(kBooleans, base) ? "Boolean" : "String";
}
constexpr const char* fmi3_element(schema::Base base) {
  switch (base) {
    case schema::Base::Bool:
      return "Boolean";
    case schema::Base::Char:
    case schema::Base::UInt8:
      return "UInt8";
    case schema::Base::Int8:
      return "Int8";
    case schema::Base::Int16:
      return "Int16";
    case schema::Base::UInt16:
      return "UInt16";
    case schema::Base::Int32:
      return "Int32";
    case schema::Base::UInt32:
      return "UInt32";
    case schema::Base::Int64:
      return "Int64";
    case schema::Base::UInt64:
      return "UInt64";
    case schema::Base::Float:
      return "Float32";
    case schema::Base::Double:
      return "Float64";
    case schema::Base::Enum:
      return "Enumeration";
    case schema::Base::Text:
    case schema::Base::Struct:
      break;
  }
  return "String";
}

}  // namespace indurop::fmi
