// SPDX-License-Identifier: Apache-2.0
// Reads JSON as a schema. The text may be damaged: a block of shared memory, or a section of a file that was cut or
// overwritten. Invalid content is rejected, not repaired.

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "core/schema/json_names.h"
#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

using nlohmann::json;

// Limits that prevent hostile text from using more memory or stack than a real schema of 10 000 variables.
constexpr std::size_t kMaxText = std::size_t{64} << 20U;
constexpr std::size_t kMaxValues = 2'000'000;
constexpr int kMaxDepth = 32;
constexpr std::size_t kMaxDims = 16;
constexpr std::size_t kMaxName = 1024;
constexpr std::uint64_t kMaxSize = std::uint64_t{1} << 30U;

// Every read_* returns false for what to_json cannot have written.

bool is_identifier(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && text.size() <= kMaxName && letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

bool is_full_name(std::string_view text) {
  for (std::size_t colons = text.find("::"); colons != std::string_view::npos; colons = text.find("::")) {
    if (!is_identifier(text.substr(0, colons))) {
      return false;
    }
    text.remove_prefix(colons + 2);
  }
  return is_identifier(text);
}

// Returns the member `key`, or null if absent.
const json* member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool read_string(const json& object, const char* key, std::string& to) {
  const json* value = member(object, key);
  if (value == nullptr) {
    return true;
  }
  if (!value->is_string()) {
    return false;
  }
  to = value->get_ref<const std::string&>();
  return true;
}

bool read_integer(const json* value, std::int64_t min, std::int64_t max, std::int64_t& to) {
  if (value == nullptr || !value->is_number_integer() ||
      (value->is_number_unsigned() && value->get<std::uint64_t>() > INT64_MAX)) {
    return false;
  }
  to = value->get<std::int64_t>();
  return to >= min && to <= max;
}

bool read_u32(const json* value, std::uint32_t& to) {
  std::int64_t number = 0;
  const bool good = read_integer(value, 0, UINT32_MAX, number);
  to = static_cast<std::uint32_t>(number);
  return good;
}

bool read_time(const json& object, const char* key, std::int64_t& to) {
  const json* value = member(object, key);
  return value == nullptr || read_integer(value, 0, INT64_MAX, to);
}

bool read_flag(const json& object, const char* key, bool& to) {
  const json* value = member(object, key);
  if (value == nullptr || !value->is_boolean()) {
    return value == nullptr;
  }
  to = value->get<bool>();
  return true;
}

bool read_limit(const json& value, double& to) {
  if (value.is_number()) {
    to = value.get<double>();
    return true;
  }
  to = value == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  return value == "inf" || value == "-inf";
}

bool read_condition(const json& object, Alarm& to) {
  const json* when = member(object, "when");
  if (when == nullptr || !when->is_array() || when->size() != 2 || !(*when)[0].is_string() ||
      !read_limit((*when)[1], to.limit)) {
    return false;
  }
  const auto& symbol = (*when)[0].get_ref<const std::string&>();
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Comparison::GreaterEqual); ++i) {
    to.comparison = static_cast<Comparison>(i);
    if (symbol == symbol_of(to.comparison)) {
      return true;
    }
  }
  return false;
}

bool read_alarms(const json& object, std::vector<Alarm>& to) {
  const json* list = member(object, "alarms");
  if (list == nullptr) {
    return true;
  }
  return list->is_array() && std::all_of(list->begin(), list->end(), [&](const json& value) {
           Alarm alarm;
           std::string word;
           if (!value.is_object() || !read_string(value, "text", alarm.text) || !read_string(value, "priority", word) ||
               !read_condition(value, alarm) || !read_time(value, "delay_ns", alarm.delay_ns)) {
             return false;
           }
           const auto priority = priority_of(word);
           const json* deadband = member(value, "deadband");
           const bool good =
               priority && (deadband == nullptr || (deadband->is_number() && deadband->get<double>() >= 0));
           if (good) {
             alarm.priority = *priority;
             alarm.deadband = deadband == nullptr ? 0 : deadband->get<double>();
             to.push_back(std::move(alarm));
           }
           return good;
         });
}

template <class Declaration>
bool read_notes(const json& object, Declaration& to) {
  if (const json* range = member(object, "range")) {
    to.range.emplace();
    if (!range->is_array() || range->size() != 2 || !read_limit((*range)[0], to.range->min) ||
        !read_limit((*range)[1], to.range->max)) {
      return false;
    }
  }
  return read_string(object, "unit", to.unit) && read_string(object, "description", to.description) &&
         read_alarms(object, to.alarms);
}

bool read_base(const json& value, Base& to) {
  if (!value.is_string()) {
    return false;
  }
  const auto* found = std::find(kBaseNames.begin(), kBaseNames.end(), value.get_ref<const std::string&>());
  to = static_cast<Base>(found - kBaseNames.begin());
  return found != kBaseNames.end();
}

bool read_enumerators(const json& object, Type& to) {
  const json* values = member(object, "values");
  if (values == nullptr || !values->is_array() || values->empty()) {
    return false;
  }
  for (const json& value : *values) {
    Enumerator e;
    if (!value.is_array() || value.size() != 2 || !value[0].is_string() ||
        !read_integer(&value[1], INT32_MIN, INT32_MAX, e.value)) {
      return false;
    }
    e.name = value[0].get_ref<const std::string&>();
    if (!is_identifier(e.name)) {
      return false;
    }
    to.enumerators.push_back(std::move(e));
  }
  return true;
}

bool read_type(const json& value, Type& to, int depth);

// Reads fields, which must be ascending, aligned and disjoint within the struct.
bool read_fields(const json& object, Type& to, int depth) {
  const json* fields = member(object, "fields");
  const bool power_of_two = to.align != 0 && (to.align & (to.align - 1)) == 0;
  if (fields == nullptr || !fields->is_array() || !power_of_two || to.align > 16 || to.element_size % to.align != 0) {
    return false;
  }
  std::uint64_t end = 0;
  std::unordered_set<std::string> names;
  for (const json& value : *fields) {
    Field field;
    if (!value.is_object() || member(value, "type") == nullptr || !read_string(value, "name", field.name) ||
        !is_identifier(field.name) || !names.insert(field.name).second ||
        !read_u32(member(value, "offset"), field.offset) || !read_notes(value, field) ||
        !read_type(value["type"], field.type, depth + 1)) {
      return false;
    }
    if (field.offset < end || field.offset % field.type.align != 0 || field.type.align > to.align) {
      return false;
    }
    end = field.offset + field.type.size();
    to.fields.push_back(std::move(field));
  }
  return end <= to.element_size;
}

bool read_dims(const json& object, Type& to) {
  const json* dims = member(object, "dims");
  if (dims == nullptr) {
    return true;
  }
  if (!dims->is_array() || dims->size() > kMaxDims) {
    return false;
  }
  return std::all_of(dims->begin(), dims->end(), [&](const json& value) {
    std::uint32_t dim = 0;
    const bool good = read_u32(&value, dim) && dim != 0;
    to.dims.push_back(dim);
    return good;
  });
}

// A struct without fields is accepted here; only functions have such structs (no parameters, no result).
bool read_type(const json& value, Type& to, int depth) {
  const bool plain = value.is_string();
  if (depth > kMaxDepth || (!plain && (!value.is_object() || member(value, "base") == nullptr)) ||
      !read_base(plain ? value : value["base"], to.base)) {
    return false;
  }
  to.element_size = size_of(to.base);
  to.align = to.element_size == 0 ? 1 : to.element_size;
  if (plain) {
    return to.element_size != 0 && to.base != Base::Enum;
  }
  if (!read_string(value, "name", to.name) || to.name.size() > kMaxName || !read_dims(value, to)) {
    return false;
  }
  if (to.base == Base::Text || to.base == Base::Struct) {
    if (!read_u32(member(value, "size"), to.element_size)) {
      return false;
    }
  }
  if (to.base == Base::Text) {
    to.text_size = to.element_size;
  } else if (to.base == Base::Struct) {
    if (!read_u32(member(value, "align"), to.align) || !read_fields(value, to, depth)) {
      return false;
    }
    if (depth == 0 && to.fields.empty()) {
      return to.dims.empty() && to.element_size <= 16;
    }
  } else if (to.base == Base::Enum && !read_enumerators(value, to)) {
    return false;
  }
  return to.element_size != 0 && to.size() <= kMaxSize && (to.base != Base::Struct || !to.fields.empty());
}

bool read_bytes(const json& object, const char* key, std::uint64_t size, std::vector<std::uint8_t>& to) {
  std::string hex;
  if (!read_string(object, key, hex)) {
    return false;
  }
  if (hex.empty()) {
    return true;
  }
  if (hex.size() != size * 2) {
    return false;
  }
  to.resize(size);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const char* digits = hex.data() + 2 * i;
    if (std::from_chars(digits, digits + 2, to[i], 16).ptr != digits + 2) {
      return false;
    }
  }
  return true;
}

bool read_variable(const json& object, Variable& to) {
  const json* type = object.is_object() ? member(object, "type") : nullptr;
  const json* kind = type != nullptr ? member(object, "kind") : nullptr;
  if (kind == nullptr || (*kind != "scalar" && *kind != "ring") || !read_string(object, "name", to.name) ||
      !is_full_name(to.name) || !read_type(*type, to.type, 0)) {
    return false;
  }
  to.kind = *kind == "scalar" ? abi::Kind::Scalar : abi::Kind::Ring;
  const std::uint64_t size = to.type.size();
  const bool fits_scalar = size == 1 || size == 2 || size == 4 || size == 8;
  const bool empty = to.type.base == Base::Struct && to.type.fields.empty();
  if (empty || (to.kind == abi::Kind::Scalar && !fits_scalar)) {
    return false;
  }
  to.type_hash = hash_of(to.type);
  const bool sound = read_notes(object, to) && read_flag(object, "retain", to.retain) &&
                     read_flag(object, "view", to.view) && read_flag(object, "optional", to.optional) &&
                     read_time(object, "maxage_ns", to.maxage_ns) && read_flag(object, "given", to.given) &&
                     read_bytes(object, "initial", size, to.initial) &&
                     read_bytes(object, "fallback", size, to.fallback) && read_string(object, "source", to.source);
  to.given = to.given || !to.initial.empty();
  return sound;
}

bool read_function(const json& object, Function& to) {
  if (!object.is_object() || member(object, "arguments") == nullptr || member(object, "result") == nullptr ||
      !read_string(object, "name", to.name) || !is_full_name(to.name) ||
      !read_type(object["arguments"], to.arguments, 0) || to.arguments.base != Base::Struct ||
      !to.arguments.dims.empty() || !read_type(object["result"], to.result, 0)) {
    return false;
  }
  to.type_hash = hash_of(to);
  return read_time(object, "deadline_ns", to.deadline_ns) && read_string(object, "description", to.description) &&
         read_string(object, "source", to.source);
}

bool read_pool(const json& object, Pool& to) {
  const json* type = object.is_object() ? member(object, "type") : nullptr;
  if (type == nullptr || !read_string(object, "name", to.name) || !is_full_name(to.name) ||
      !read_type(*type, to.type, 0) || to.type.base != Base::Struct || to.type.fields.empty() ||
      to.type.dims.size() != 1 || to.type.dims[0] < kMinChunks || to.type.dims[0] > kMaxChunks) {
    return false;
  }
  to.type_hash = hash_of(to.type);
  return read_string(object, "description", to.description) && read_string(object, "source", to.source);
}

template <class T>
bool read_list(const json& object, const char* key, bool (*read)(const json&, T&), std::vector<T>& to) {
  const json* list = member(object, key);
  if (list == nullptr) {
    return true;
  }
  if (!list->is_array()) {
    return false;
  }
  return std::all_of(list->begin(), list->end(), [&](const json& value) {
    to.emplace_back();
    return read(value, to.back());
  });
}

Errc read_line(std::string_view line, Schema& to) {
  const json object = json::parse(line.begin(), line.end(), nullptr, false);
  const json* version = object.is_object() ? member(object, "schema") : nullptr;
  if (version == nullptr || !version->is_number_integer()) {
    return Errc::Corrupt;
  }
  if (*version != kSchemaVersion) {
    return Errc::VersionMismatch;
  }
  const bool good = read_list(object, "variables", read_variable, to.variables) &&
                    read_list(object, "functions", read_function, to.functions) &&
                    read_list(object, "pools", read_pool, to.pools);
  return good ? Errc::Ok : Errc::Corrupt;
}

// Returns an upper bound of the number of values in JSON text, so that the parser's memory is known before it runs.
std::size_t count_values(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; }));
}

}  // namespace

Result<Schema> from_json(std::string_view text) {
  constexpr const char* kWhere = "reading the schema text";
  if (text.size() > kMaxText || count_values(text) > kMaxValues) {
    return Error{Errc::Corrupt, 0, kWhere};
  }
  Schema all;
  std::unordered_set<std::string_view> seen;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || !seen.insert(line).second) {
      continue;
    }
    if (const Errc code = read_line(line, all); code != Errc::Ok) {
      return Error{code, 0, kWhere};
    }
  }
  Schema merged;
  std::vector<std::string> differences;
  merge(merged, all, differences);
  if (!differences.empty()) {
    return Error{Errc::TypeMismatch, 0, "one module declares a variable with two types; rebuild all of it"};
  }
  return merged;
}

}  // namespace indurop::schema
