// SPDX-License-Identifier: Apache-2.0
#include "tools/table.h"

#include <algorithm>

#include "tools/units.h"

namespace indurop::tools {
namespace {

std::string padded(std::string_view text, std::size_t width, Align align) {
  const std::size_t have = display_width(text);
  const std::string gap(width > have ? width - have : 0, ' ');
  return align == Align::Right ? gap + std::string(text) : std::string(text) + gap;
}

void trim_right(std::string& text) {
  const auto last = text.find_last_not_of(' ');
  text.erase(last == std::string::npos ? 0 : last + 1);
}

}  // namespace

std::string Table::text(const Output& output) const {
  if (rows_.empty()) {
    return {};
  }
  std::vector<std::size_t> widths(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths[c] = display_width(columns_[c].title);
    for (const auto& row : rows_) {
      widths[c] = std::max(widths[c], display_width(printable(row[c].text)));
    }
  }
  std::string out;
  std::string heading;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!columns_[c].title.empty()) {
      heading += padded(columns_[c].title, widths[c], columns_[c].align) + "  ";
    }
  }
  trim_right(heading);
  out += output.paint(Style::Bold, heading) + "\n";
  for (const auto& row : rows_) {
    std::string plain;
    std::string gap;  // written only when something follows, so no line ends in spaces
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (columns_[c].title.empty()) {
        continue;
      }
      const std::string cell = printable(row[c].text);
      const std::string filled = padded(cell, widths[c], columns_[c].align);
      if (cell.empty()) {
        gap += filled + "  ";
        continue;
      }
      const auto first = filled.find(cell);
      plain += gap + filled.substr(0, first) + output.paint(row[c].style, cell);
      gap = filled.substr(first + cell.size()) + "  ";
    }
    out += plain + "\n";
  }
  return out;
}

std::string Table::csv() const {
  std::string out;
  const char* separator = "";
  for (const auto& column : columns_) {
    if (!column.key.empty()) {
      out += separator + csv_field(column.key);
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

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return std::string(text);
  }
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') {
      out += '"';
    }
  }
  return out + "\"";
}

std::string csv_value(const JsonValue& value) {
  if (value.is_null()) {
    return {};
  }
  if (value.is_string()) {
    return csv_field(value.get_ref<const std::string&>());
  }
  if (value.is_array() && std::all_of(value.begin(), value.end(), [](const JsonValue& e) { return e.is_string(); })) {
    std::string joined;
    for (const auto& entry : value) {
      joined += (joined.empty() ? "" : " ") + entry.get<std::string>();
    }
    return csv_field(joined);
  }
  return csv_field(dump(value));
}

std::string dump(const JsonValue& value) {
  return value.dump(-1, ' ', false, JsonValue::error_handler_t::replace);
}

}  // namespace indurop::tools
