// SPDX-License-Identifier: Apache-2.0
#include "tools/console/table_text.h"

#include <algorithm>

#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kGap = 2;

// Width per column, 0 for columns that are not shown.
std::vector<std::size_t> widths_of(const Table& table, const Output& output) {
  const std::vector<Column>& columns = table.columns();
  std::vector<std::size_t> out(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Column& column = columns[c];
    if (column.title.empty()) {
      continue;
    }
    bool any = false;
    for (const auto& row : table.rows()) {
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
    std::size_t victim = columns.size();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (out[c] > 0 && columns[c].drop > (victim < columns.size() ? columns[victim].drop : 0)) {
        victim = c;
      }
    }
    if (victim == columns.size()) {
      break;
    }
    out[victim] = 0;
  }
  return out;
}

std::string row_text(const std::vector<Column>& columns, const std::vector<Cell>& row,
                     const std::vector<std::size_t>& widths, const Output& output) {
  std::string out;
  std::string gap;  // written only when text follows, so no line ends in spaces
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (widths[c] == 0) {
      continue;
    }
    const std::string cell = printable(row[c].text);
    const std::size_t have = display_width(cell);
    const std::string fill(widths[c] > have ? widths[c] - have : 0, ' ');
    const bool right = columns[c].align == Align::Right;
    if (!cell.empty()) {
      out += gap + (right ? fill : "") + output.paint(row[c].style, cell);
      gap.clear();
    }
    gap += (right && !cell.empty() ? "" : fill) + std::string(kGap, ' ');
  }
  return out;
}

}  // namespace

std::string table_text(const Table& table, const Output& output) {
  if (table.empty()) {
    return {};
  }
  const std::vector<Column>& columns = table.columns();
  const std::vector<std::size_t> widths = widths_of(table, output);
  std::vector<Cell> heading;
  for (const Column& column : columns) {
    heading.emplace_back(column.title);
  }
  const Output plain(ColorWhen::Never);
  std::string out = output.paint(Style::Bold, row_text(columns, heading, widths, plain)) + "\n";
  for (const auto& row : table.rows()) {
    out += row_text(columns, row, widths, output) + "\n";
  }
  return out;
}

}  // namespace indurop::tools
