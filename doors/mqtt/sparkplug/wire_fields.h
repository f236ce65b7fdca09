// SPDX-License-Identifier: Apache-2.0
// Fields of protocol buffer messages: numbers, bytes and messages behind their tags.

#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::mqtt {

enum class WireKind : std::uint32_t { Varint = 0, Fixed64 = 1, Bytes = 2, Fixed32 = 5 };

inline constexpr unsigned kTagBits = 3;
inline constexpr unsigned kVarintBits = 7;
inline constexpr unsigned kMoreFollows = 0x80;

static_assert(std::endian::native == std::endian::little);  // as the wire is

inline void put_varint(std::string& to, std::uint64_t value) {
  while (value >= kMoreFollows) {
    to += static_cast<char>(value | kMoreFollows);
    value >>= kVarintBits;
  }
  to += static_cast<char>(value);
}

inline void put_tag(std::string& to, std::uint32_t field, WireKind kind) {
  put_varint(to, (field << kTagBits) | static_cast<std::uint32_t>(kind));
}

inline void put_number(std::string& to, std::uint32_t field, std::uint64_t value) {
  put_tag(to, field, WireKind::Varint);
  put_varint(to, value);
}

template <class T>
void put_fixed(std::string& to, std::uint32_t field, T value) {
  static_assert(sizeof value == 4 || sizeof value == 8);
  put_tag(to, field, sizeof value == 4 ? WireKind::Fixed32 : WireKind::Fixed64);
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_bytes(std::string& to, std::uint32_t field, std::string_view bytes) {
  put_tag(to, field, WireKind::Bytes);
  put_varint(to, bytes.size());
  to += bytes;
}

// One field as it was read.
struct WireField {
  std::uint32_t number = 0;
  WireKind kind = WireKind::Varint;
  std::uint64_t value = 0;  // of numbers, the bits of fixed ones
  std::string_view bytes;   // of WireKind::Bytes
};

// Removes a varint from the front; nothing if there is none.
inline std::optional<std::uint64_t> take_varint(std::string_view& from) {
  constexpr unsigned kMostBits = 64;
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < kMostBits && !from.empty(); shift += kVarintBits) {
    const auto byte = static_cast<unsigned char>(from.front());
    from.remove_prefix(1);
    value |= static_cast<std::uint64_t>(byte & ~kMoreFollows) << shift;
    if ((byte & kMoreFollows) == 0) {
      return value;
    }
  }
  return std::nullopt;
}

// Removes the bits of a fixed number from the front.
template <class T>
std::optional<std::uint64_t> take_fixed(std::string_view& from) {
  T bits = 0;
  if (from.size() < sizeof bits) {
    return std::nullopt;
  }
  std::memcpy(&bits, from.data(), sizeof bits);
  from.remove_prefix(sizeof bits);
  return bits;
}

// Removes a field from the front of a message; nothing if it is none.
inline std::optional<WireField> take_field(std::string_view& from) {
  const auto tag = take_varint(from);
  if (!tag || (*tag >> kTagBits) == 0 || (*tag >> kTagBits) > UINT32_MAX) {
    return std::nullopt;
  }
  WireField field;
  field.number = static_cast<std::uint32_t>(*tag >> kTagBits);
  field.kind = static_cast<WireKind>(*tag & ((1U << kTagBits) - 1));
  std::optional<std::uint64_t> value;
  switch (field.kind) {
    case WireKind::Varint:
    case WireKind::Bytes:
      value = take_varint(from);
      break;
    case WireKind::Fixed64:
      value = take_fixed<std::uint64_t>(from);
      break;
    case WireKind::Fixed32:
      value = take_fixed<std::uint32_t>(from);
      break;
  }
  if (!value || (field.kind == WireKind::Bytes && *value > from.size())) {
    return std::nullopt;
  }
  field.value = *value;
  if (field.kind == WireKind::Bytes) {
    field.bytes = from.substr(0, static_cast<std::size_t>(*value));
    from.remove_prefix(static_cast<std::size_t>(*value));
  }
  return field;
}

}  // namespace indurop::mqtt
