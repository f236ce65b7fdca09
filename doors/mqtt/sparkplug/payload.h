// SPDX-License-Identifier: Apache-2.0
// Payloads of Sparkplug B: the fields of its protocol buffer message that this program uses. Others are passed over
// when reading.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace indurop::mqtt {

// The numbers of the specification.
enum class DataType : std::uint32_t {
  Int8 = 1,
  Int16 = 2,
  Int32 = 3,
  Int64 = 4,
  UInt8 = 5,
  UInt16 = 6,
  UInt32 = 7,
  UInt64 = 8,
  Float = 9,
  Double = 10,
  Boolean = 11,
  String = 12,
};

// A value as it travels: nothing (null), a boolean, 32 bits (integers up to 32 bits with a sign, or 16 without), 64
// bits (the other integers), a float, a double, a text. Negative integers are in two's complement.
using WireValue = std::variant<std::monostate, bool, std::uint32_t, std::uint64_t, float, double, std::string>;

struct Metric {
  std::string name;  // empty: the alias counts
  std::optional<std::uint64_t> alias;
  std::optional<std::uint64_t> timestamp_ms;  // since 1970
  std::optional<std::uint32_t> datatype;      // DataType
  bool is_historical = false;
  WireValue value;
  std::string unit;                     // property engUnit; empty: none. Not read
  std::optional<std::int32_t> quality;  // property Quality. Not read
};

struct Payload {
  std::optional<std::uint64_t> timestamp_ms;
  std::optional<std::uint64_t> seq;
  std::vector<Metric> metrics;
};

std::string encode(const Payload& payload);
// Returns nothing if the bytes are no such message.
std::optional<Payload> decode(std::string_view bytes);

// Values of the property Quality.
inline constexpr std::int32_t kQualityBad = 0;
inline constexpr std::int32_t kQualityGood = 192;
inline constexpr std::int32_t kQualityStale = 500;

}  // namespace indurop::mqtt
