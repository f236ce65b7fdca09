// SPDX-License-Identifier: Apache-2.0
// Writes a schema as JSON, and reads the version in it.

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/hexadecimal.h"
#include "core/schema/json_names.h"
#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

using nlohmann::ordered_json;

ordered_json number_json(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(value > 0 ? "inf" : "-inf");
}

ordered_json alarm_json(const Alarm& alarm) {
  ordered_json out{{"text", alarm.text}, {"priority", word_of(alarm.priority)}};
  out["when"] = ordered_json::array({symbol_of(alarm.comparison), number_json(alarm.limit)});
  if (alarm.deadband != 0) {
    out["deadband"] = alarm.deadband;
  }
  if (alarm.delay_ns != 0) {
    out["delay_ns"] = alarm.delay_ns;
  }
  return out;
}

template <class Declaration>
void write_notes(ordered_json& out, const Declaration& from) {
  if (!from.unit.empty()) {
    out["unit"] = from.unit;
  }
  if (!from.description.empty()) {
    out["description"] = from.description;
  }
  if (from.range) {
    out["range"] = ordered_json::array({number_json(from.range->min), number_json(from.range->max)});
  }
  for (const Alarm& alarm : from.alarms) {
    out["alarms"].push_back(alarm_json(alarm));
  }
}

ordered_json type_json(const Type& type) {
  const char* base = kBaseNames[static_cast<std::size_t>(type.base)];
  const bool plain = size_of(type.base) != 0 && type.base != Base::Enum;
  if (plain && type.dims.empty()) {
    return base;
  }
  ordered_json out{{"base", base}};
  if (!type.name.empty()) {
    out["name"] = type.name;
  }
  if (type.base == Base::Text) {
    out["size"] = type.text_size;
  } else if (type.base == Base::Enum) {
    ordered_json values = ordered_json::array();
    for (const Enumerator& e : type.enumerators) {
      values.push_back(ordered_json::array({e.name, e.value}));
    }
    out["values"] = std::move(values);
  } else if (type.base == Base::Struct) {
    out["size"] = type.element_size;
    out["align"] = type.align;
    ordered_json fields = ordered_json::array();
    for (const Field& field : type.fields) {
      ordered_json f{{"name", field.name}, {"type", type_json(field.type)}, {"offset", field.offset}};
      write_notes(f, field);
      fields.push_back(std::move(f));
    }
    out["fields"] = std::move(fields);
  }
  if (!type.dims.empty()) {
    out["dims"] = type.dims;
  }
  return out;
}

ordered_json variable_json(const Variable& variable) {
  ordered_json out{{"name", variable.name},
                   {"type", type_json(variable.type)},
                   {"kind", variable.kind == abi::Kind::Scalar ? "scalar" : "ring"}};
  write_notes(out, variable);
  if (variable.retain) {
    out["retain"] = true;
  }
  if (variable.view) {
    out["view"] = true;
  }
  if (variable.optional) {
    out["optional"] = true;
  }
  if (variable.maxage_ns != 0) {
    out["maxage_ns"] = variable.maxage_ns;
  }
  if (!variable.initial.empty()) {
    out["initial"] = base::in_hexadecimal(variable.initial);
  } else if (variable.given) {
    out["given"] = true;
  }
  if (!variable.fallback.empty()) {
    out["fallback"] = base::in_hexadecimal(variable.fallback);
  }
  if (!variable.source.empty()) {
    out["source"] = variable.source;
  }
  return out;
}

ordered_json function_json(const Function& function) {
  ordered_json out{
      {"name", function.name}, {"arguments", type_json(function.arguments)}, {"result", type_json(function.result)}};
  if (function.deadline_ns != 0) {
    out["deadline_ns"] = function.deadline_ns;
  }
  if (!function.description.empty()) {
    out["description"] = function.description;
  }
  if (!function.source.empty()) {
    out["source"] = function.source;
  }
  return out;
}

ordered_json pool_json(const Pool& pool) {
  ordered_json out{{"name", pool.name}, {"type", type_json(pool.type)}};
  if (!pool.description.empty()) {
    out["description"] = pool.description;
  }
  if (!pool.source.empty()) {
    out["source"] = pool.source;
  }
  return out;
}

}  // namespace

std::string to_json(const Schema& schema) {
  ordered_json out{{"schema", kSchemaVersion}, {"abi", abi::kVersion}};
  if (!schema.variables.empty()) {
    ordered_json& list = out["variables"] = ordered_json::array();
    for (const Variable& variable : schema.variables) {
      list.push_back(variable_json(variable));
    }
  }
  if (!schema.functions.empty()) {
    ordered_json& list = out["functions"] = ordered_json::array();
    for (const Function& function : schema.functions) {
      list.push_back(function_json(function));
    }
  }
  if (!schema.pools.empty()) {
    ordered_json& list = out["pools"] = ordered_json::array();
    for (const Pool& pool : schema.pools) {
      list.push_back(pool_json(pool));
    }
  }
  return out.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

// The text begins with the two numbers.
std::uint32_t abi_of_json(std::string_view text) noexcept {
  constexpr std::string_view kKey = "\"abi\":";
  const std::size_t found = text.substr(0, 64).find(kKey);
  std::uint32_t abi = 0;
  if (found != std::string_view::npos) {
    std::from_chars(text.data() + found + kKey.size(), text.data() + text.size(), abi);
  }
  return abi;
}

}  // namespace indurop::schema
