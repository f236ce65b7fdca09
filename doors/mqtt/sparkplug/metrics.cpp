// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/sparkplug/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/printable.h"
#include "core/schema/leaf.h"

namespace indurop::mqtt {
namespace {

using schema::Base;

bool is_signed(Base base) noexcept {
  return base == Base::Int8 || base == Base::Int16 || base == Base::Int32 || base == Base::Int64 || base == Base::Enum;
}

base::Json json_of_real(double value) {
  // A host may send a whole number as a double; numbers of integers must be whole.
  constexpr double kMostExact = 9007199254740992;
  return std::floor(value) == value && std::abs(value) <= kMostExact ? base::Json(static_cast<std::int64_t>(value))
                                                                     : base::Json(value);
}

}  // namespace

DataType data_type_of(Base base) noexcept {
  switch (base) {
    case Base::Bool:
      return DataType::Boolean;
    case Base::Int8:
      return DataType::Int8;
    case Base::Char:
    case Base::UInt8:
      return DataType::UInt8;
    case Base::Int16:
      return DataType::Int16;
    case Base::UInt16:
      return DataType::UInt16;
    case Base::Int32:
    case Base::Enum:
      return DataType::Int32;
    case Base::UInt32:
      return DataType::UInt32;
    case Base::Int64:
      return DataType::Int64;
    case Base::UInt64:
      return DataType::UInt64;
    case Base::Float:
      return DataType::Float;
    case Base::Double:
      return DataType::Double;
    case Base::Text:
    case Base::Struct:
      break;
  }
  return DataType::String;
}

WireValue wire_value_of(const Leaf& leaf, std::span<const std::uint8_t> bytes) {
  const std::uint8_t* const at = bytes.data();
  switch (data_type_of(leaf.base)) {
    case DataType::Boolean:
      return *at != 0;
    case DataType::Int8:
    case DataType::Int16:
    case DataType::Int32:
    case DataType::UInt8:
    case DataType::UInt16:
      return static_cast<std::uint32_t>(schema::as_number<std::int64_t>(leaf.base, at).value_or(0));
    case DataType::UInt32:
    case DataType::UInt64:
      return schema::as_number<std::uint64_t>(leaf.base, at).value_or(0);
    case DataType::Int64:
      return static_cast<std::uint64_t>(schema::load<std::int64_t>(at));
    case DataType::Float:
      return schema::load<float>(at);
    case DataType::Double:
      return schema::load<double>(at);
    case DataType::String:
      break;
  }
  const auto* const text = reinterpret_cast<const char*>(at);
  return base::printable({text, strnlen(text, leaf.size)}, "\t\r\n");
}

std::optional<base::Json> json_for(Base base, const WireValue& value) {
  const bool wants_text = base == Base::Text;
  if (const auto* const text = std::get_if<std::string>(&value)) {
    return wants_text ? std::optional(base::Json(*text)) : std::nullopt;
  }
  if (wants_text || std::holds_alternative<std::monostate>(value)) {
    return std::nullopt;
  }
  if (const auto* const flag = std::get_if<bool>(&value)) {
    return base == Base::Bool ? std::optional(base::Json(*flag)) : std::nullopt;
  }
  if (base == Base::Bool) {
    return std::nullopt;
  }
  if (const auto* const single = std::get_if<float>(&value)) {
    return json_of_real(static_cast<double>(*single));
  }
  if (const auto* const real = std::get_if<double>(&value)) {
    return json_of_real(*real);
  }
  if (const auto* const narrow = std::get_if<std::uint32_t>(&value)) {
    return is_signed(base) ? base::Json(static_cast<std::int32_t>(*narrow)) : base::Json(*narrow);
  }
  const auto wide = std::get<std::uint64_t>(value);
  return is_signed(base) ? base::Json(static_cast<std::int64_t>(wide)) : base::Json(wide);
}

std::int32_t sparkplug_quality(Quality quality) noexcept {
  switch (quality) {
    case Quality::Good:
      return kQualityGood;
    case Quality::Stale:
    case Quality::Silent:
      return kQualityStale;
    case Quality::Unread:
    case Quality::Stopped:
      break;
  }
  return kQualityBad;
}

std::string metric_name(std::string_view leaf) {
  std::string out;
  for (std::size_t i = 0; i < leaf.size(); ++i) {
    const bool colons = leaf.substr(i).starts_with("::");
    out += colons || leaf[i] == '.' ? '/' : leaf[i];
    i += colons ? 1 : 0;
  }
  return out;
}

AliasTable::AliasTable(const Board& board, std::uint64_t first) : first_(first) {
  for (std::size_t i = 0; i < board.variables().size(); ++i) {
    begin_.push_back(count_);
    const auto& leaves = board.variables()[i].leaves;
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
      by_name_.emplace(metric_name(leaves[leaf].name), Place{i, leaf});
    }
    count_ += leaves.size();
  }
}

std::optional<AliasTable::Place> AliasTable::find(const Metric& metric) const {
  if (!metric.name.empty()) {
    const auto found = by_name_.find(metric.name);
    return found != by_name_.end() ? std::optional(found->second) : std::nullopt;
  }
  if (!metric.alias || *metric.alias < first_ || *metric.alias >= end()) {
    return std::nullopt;
  }
  const std::uint64_t index = *metric.alias - first_;
  const auto after = std::upper_bound(begin_.begin(), begin_.end(), index);
  const auto variable = static_cast<std::size_t>(after - begin_.begin()) - 1;
  return Place{variable, static_cast<std::size_t>(index - begin_[variable])};
}

}  // namespace indurop::mqtt
