// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/sparkplug/payload.h"

#include <bit>

#include "doors/mqtt/sparkplug/wire_fields.h"

namespace indurop::mqtt {
namespace {

// Numbers of fields, from the specification.
namespace payload_field {
constexpr std::uint32_t kTimestamp = 1;
constexpr std::uint32_t kMetrics = 2;
constexpr std::uint32_t kSeq = 3;
}  // namespace payload_field
namespace metric_field {
constexpr std::uint32_t kName = 1;
constexpr std::uint32_t kAlias = 2;
constexpr std::uint32_t kTimestamp = 3;
constexpr std::uint32_t kDatatype = 4;
constexpr std::uint32_t kIsHistorical = 5;
constexpr std::uint32_t kIsNull = 7;
constexpr std::uint32_t kProperties = 9;
constexpr std::uint32_t kInt = 10;
constexpr std::uint32_t kLong = 11;
constexpr std::uint32_t kFloat = 12;
constexpr std::uint32_t kDouble = 13;
constexpr std::uint32_t kBoolean = 14;
constexpr std::uint32_t kString = 15;
}  // namespace metric_field
namespace property_field {
constexpr std::uint32_t kKeys = 1;
constexpr std::uint32_t kValues = 2;
constexpr std::uint32_t kType = 1;
constexpr std::uint32_t kInt = 3;
constexpr std::uint32_t kString = 8;
}  // namespace property_field

void put_value(std::string& to, const WireValue& value) {
  if (std::holds_alternative<std::monostate>(value)) {
    put_number(to, metric_field::kIsNull, 1);
  } else if (const auto* const flag = std::get_if<bool>(&value)) {
    put_number(to, metric_field::kBoolean, *flag ? 1 : 0);
  } else if (const auto* const narrow = std::get_if<std::uint32_t>(&value)) {
    put_number(to, metric_field::kInt, *narrow);
  } else if (const auto* const wide = std::get_if<std::uint64_t>(&value)) {
    put_number(to, metric_field::kLong, *wide);
  } else if (const auto* const single = std::get_if<float>(&value)) {
    put_fixed(to, metric_field::kFloat, *single);
  } else if (const auto* const real = std::get_if<double>(&value)) {
    put_fixed(to, metric_field::kDouble, *real);
  } else {
    put_bytes(to, metric_field::kString, std::get<std::string>(value));
  }
}

// A property set has its keys first, then the values in the same order.
std::string properties_of(const Metric& metric) {
  std::string out;
  if (!metric.unit.empty()) {
    put_bytes(out, property_field::kKeys, "engUnit");
  }
  if (metric.quality) {
    put_bytes(out, property_field::kKeys, "Quality");
  }
  if (!metric.unit.empty()) {
    std::string value;
    put_number(value, property_field::kType, static_cast<std::uint32_t>(DataType::String));
    put_bytes(value, property_field::kString, metric.unit);
    put_bytes(out, property_field::kValues, value);
  }
  if (metric.quality) {
    std::string value;
    put_number(value, property_field::kType, static_cast<std::uint32_t>(DataType::Int32));
    put_number(value, property_field::kInt, static_cast<std::uint32_t>(*metric.quality));
    put_bytes(out, property_field::kValues, value);
  }
  return out;
}

std::string encode_metric(const Metric& metric) {
  std::string out;
  if (!metric.name.empty()) {
    put_bytes(out, metric_field::kName, metric.name);
  }
  if (metric.alias) {
    put_number(out, metric_field::kAlias, *metric.alias);
  }
  if (metric.timestamp_ms) {
    put_number(out, metric_field::kTimestamp, *metric.timestamp_ms);
  }
  if (metric.datatype) {
    put_number(out, metric_field::kDatatype, *metric.datatype);
  }
  if (metric.is_historical) {
    put_number(out, metric_field::kIsHistorical, 1);
  }
  if (const std::string properties = properties_of(metric); !properties.empty()) {
    put_bytes(out, metric_field::kProperties, properties);
  }
  put_value(out, metric.value);
  return out;
}

// Takes over a field with a number; unknown ones are passed over.
void read_number(const WireField& field, Metric& metric, bool& is_null) {
  switch (field.number) {
    case metric_field::kAlias:
      metric.alias = field.value;
      break;
    case metric_field::kTimestamp:
      metric.timestamp_ms = field.value;
      break;
    case metric_field::kDatatype:
      metric.datatype = static_cast<std::uint32_t>(field.value);
      break;
    case metric_field::kIsHistorical:
      metric.is_historical = field.value != 0;
      break;
    case metric_field::kIsNull:
      is_null = field.value != 0;
      break;
    case metric_field::kInt:
      metric.value = static_cast<std::uint32_t>(field.value);
      break;
    case metric_field::kLong:
      metric.value = field.value;
      break;
    case metric_field::kBoolean:
      metric.value = field.value != 0;
      break;
    default:
      break;
  }
}

std::optional<Metric> decode_metric(std::string_view bytes) {
  Metric metric;
  bool is_null = false;
  while (!bytes.empty()) {
    const auto field = take_field(bytes);
    if (!field) {
      return std::nullopt;
    }
    if (field->kind == WireKind::Varint) {
      read_number(*field, metric, is_null);
    } else if (field->kind == WireKind::Bytes && field->number == metric_field::kName) {
      metric.name = field->bytes;
    } else if (field->kind == WireKind::Bytes && field->number == metric_field::kString) {
      metric.value = std::string(field->bytes);
    } else if (field->kind == WireKind::Fixed32 && field->number == metric_field::kFloat) {
      metric.value = std::bit_cast<float>(static_cast<std::uint32_t>(field->value));
    } else if (field->kind == WireKind::Fixed64 && field->number == metric_field::kDouble) {
      metric.value = std::bit_cast<double>(field->value);
    }
  }
  if (is_null) {
    metric.value = std::monostate();
  }
  return metric;
}

}  // namespace

std::string encode(const Payload& payload) {
  std::string out;
  if (payload.timestamp_ms) {
    put_number(out, payload_field::kTimestamp, *payload.timestamp_ms);
  }
  for (const Metric& metric : payload.metrics) {
    put_bytes(out, payload_field::kMetrics, encode_metric(metric));
  }
  if (payload.seq) {
    put_number(out, payload_field::kSeq, *payload.seq);
  }
  return out;
}

std::optional<Payload> decode(std::string_view bytes) {
  Payload payload;
  while (!bytes.empty()) {
    const auto field = take_field(bytes);
    if (!field) {
      return std::nullopt;
    }
    if (field->kind == WireKind::Varint && field->number == payload_field::kTimestamp) {
      payload.timestamp_ms = field->value;
    } else if (field->kind == WireKind::Varint && field->number == payload_field::kSeq) {
      payload.seq = field->value;
    } else if (field->kind == WireKind::Bytes && field->number == payload_field::kMetrics) {
      auto metric = decode_metric(field->bytes);
      if (!metric) {
        return std::nullopt;
      }
      payload.metrics.push_back(std::move(*metric));
    }
  }
  return payload;
}

}  // namespace indurop::mqtt
