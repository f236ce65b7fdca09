// SPDX-License-Identifier: Apache-2.0
// Rows of CSV files (RFC 4180): cells between separators; a cell in quotes may contain separators, line ends and,
// doubled, quotes.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::base {

struct CsvCell {
  std::string text;        // without its quotes
  std::size_t line = 1;    // of its first character, from 1
  std::size_t column = 1;  // of its first character, in bytes, from 1
};

// Removes one row with its line end from the front of `text`, which is not empty. The row begins in line `line`, which
// is advanced to that of the next row.
std::vector<CsvCell> take_csv_row(std::string_view& text, char separator, std::size_t& line);

// Returns a cell as written in such a row: in quotes if necessary, quotes doubled.
std::string csv_field(std::string_view text);

// Returns the seconds per unit of a time column by its name: time or time_s, time_ms, time_us, time_ns; 0: not a time
// column.
double csv_time_unit(std::string_view name) noexcept;

}  // namespace indurop::base
