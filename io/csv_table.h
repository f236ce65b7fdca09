// SPDX-License-Identifier: Apache-2.0
// A CSV file of recorded values: a first row with names, a first column with times, numbers or nothing in between.

#pragma once

#include <indurop/result.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace indurop::io {

struct CsvRow {
  std::int64_t time_ns = 0;    // from the first row on, strictly rising
  std::vector<double> values;  // as CsvTable::columns; NaN: the cell is empty
};

struct CsvTable {
  std::vector<std::string> columns;  // without that of the time
  std::vector<CsvRow> rows;
};

// Cells are separated by ',' or ';', whichever the first row has; a quoted cell may contain it. The first column is
// called time, time_s, time_ms, time_us or time_ns. Lines that are empty or begin with '#' are skipped. Errors: all
// that is wrong with the text of `file`, at most 20.
Result<CsvTable, std::vector<base::Diagnostic>> read_csv(std::string_view text, const std::string& file);

}  // namespace indurop::io
