// SPDX-License-Identifier: Apache-2.0
// Rows as a table for people, CSV and JSON for programs: every cell has a text and a raw value. A column without title
// is left out of the table, one without key out of CSV and JSON.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/json.h"
#include "tools/client/text/style.h"

namespace indurop::tools {

using JsonValue = base::Json;

// Version of the field names of every JSON document of these programs ("schema_version").
inline constexpr int kJsonVersion = 1;

enum class Align { Left, Right };

struct Column {
  std::string title;  // as printed in the heading
  std::string key;    // JSON field and CSV heading
  Align align = Align::Left;
  int drop = 0;          // if the terminal is too narrow, columns with the highest number are left out first; 0: never
  std::size_t most = 0;  // longer cells do not widen the column, they extend beyond it; 0: no limit
};

struct Cell {
  Cell(std::string shown, JsonValue value, Style look = Style::None)
      : text(std::move(shown)), raw(std::move(value)), style(look) {}
  explicit Cell(const std::string& both, Style look = Style::None) : text(both), raw(both), style(look) {}
  std::string text;
  JsonValue raw;
  Style style;
};

// "a, b", or "-" for none.
Cell name_list(const std::vector<std::string>& names);

class Table {
 public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  // Adds a row with one cell for each column.
  void add(std::vector<Cell> cells) { rows_.push_back(std::move(cells)); }
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }

  [[nodiscard]] const std::vector<Column>& columns() const noexcept { return columns_; }
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const noexcept { return rows_; }

  // RFC 4180 with a heading, lines ended by \n.
  [[nodiscard]] std::string csv() const;
  [[nodiscard]] JsonValue json() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

// Scalar JSON as CSV text: strings without quotes, null as nothing.
std::string csv_value(const JsonValue& value);

}  // namespace indurop::tools
