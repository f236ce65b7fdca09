// SPDX-License-Identifier: Apache-2.0
#include "tools/client/text/table.h"

#include <algorithm>

#include "core/base/csv_row.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kGap = 2;

}  // namespace

std::vector<std::size_t> Table::widths(const Output& output) const {
  std::vector<std::size_t> out(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (column.title.empty()) {
      continue;
    }
    bool any = false;
    for (const auto& row : rows_) {
      const std::size_t width = display_width(printable(row[c].text));
      any = any || width > 0;
      out[c] = std::max(out[c], column.most == 0 || width <= column.most ? width : 0);
    }
    out[c] = any ? std::max(out[c], display_width(column.title)) : 0;
  }
  const auto total = [&out] {
    std::size_t sum = 0;
    for (const std::size_t width : out) {
      sum += width > 0 ? width + kGap : 0;
    }
    return sum;
  };
  while (output.terminal() && total() > static_cast<std::size_t>(output.extent().columns) + kGap) {
    std::size_t victim = columns_.size();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (out[c] > 0 && columns_[c].drop > (victim < columns_.size() ? columns_[victim].drop : 0)) {
        victim = c;
      }
    }
    if (victim == columns_.size()) {
      break;
    }
    out[victim] = 0;
  }
  return out;
}

std::string Table::row_text(const std::vector<Cell>& row, const std::vector<std::size_t>& widths,
                            const Output& output) const {
  std::string out;
  std::string gap;  // written only when text follows, so no line ends in spaces
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (widths[c] == 0) {
      continue;
    }
    const std::string cell = printable(row[c].text);
    const std::size_t have = display_width(cell);
    const std::string fill(widths[c] > have ? widths[c] - have : 0, ' ');
    const bool right = columns_[c].align == Align::Right;
    if (!cell.empty()) {
      out += gap + (right ? fill : "") + output.paint(row[c].style, cell);
      gap.clear();
    }
    gap += (right && !cell.empty() ? "" : fill) + std::string(kGap, ' ');
  }
  return out;
}

std::string Table::text(const Output& output) const {
  if (rows_.empty()) {
    return {};
  }
  const auto columns = widths(output);
  std::vector<Cell> heading;
  for (const Column& column : columns_) {
    heading.emplace_back(column.title);
  }
  const Output plain(ColorWhen::Never);
  std::string out = output.paint(Style::Bold, row_text(heading, columns, plain)) + "\n";
  for (const auto& row : rows_) {
    out += row_text(row, columns, output) + "\n";
  }
  return out;
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
