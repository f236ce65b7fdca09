// SPDX-License-Identifier: Apache-2.0
#include "tools/client/text/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/csv_row.h"

namespace indurop::tools {

Cell name_list(const std::vector<std::string>& names) {
  return {names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", ")), JsonValue(names)};
}

std::string Table::csv() const {
  std::string out;
  const char* separator = "";
  for (const auto& column : columns_) {
    if (!column.key.empty()) {
      out += separator + base::csv_field(column.key);
      separator = ",";
    }
  }
  out += '\n';
  for (const auto& row : rows_) {
    separator = "";
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!columns_[c].key.empty()) {
        out += separator + csv_value(row[c].raw);
        separator = ",";
      }
    }
    out += '\n';
  }
  return out;
}

JsonValue Table::json() const {
  JsonValue out = JsonValue::array();
  for (const auto& row : rows_) {
    JsonValue object = JsonValue::object();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!columns_[c].key.empty()) {
        object[columns_[c].key] = row[c].raw;
      }
    }
    out.push_back(std::move(object));
  }
  return out;
}

std::string csv_value(const JsonValue& value) {
  if (value.is_null()) {
    return {};
  }
  if (const auto text = value.text()) {
    return base::csv_field(*text);
  }
  const auto entries = value.values();
  if (value.is_array() && std::all_of(entries.begin(), entries.end(), [](const auto& e) { return e.is_text(); })) {
    std::string joined;
    for (const JsonValue& entry : entries) {
      joined += (joined.empty() ? "" : " ") + *entry.text();
    }
    return base::csv_field(joined);
  }
  return base::csv_field(value.dump());
}

}  // namespace indurop::tools
