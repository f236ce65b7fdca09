// SPDX-License-Identifier: Apache-2.0
// A CSV file of recorded values: a first row with names, a first column with times, numbers or nothing in between.

#pragma once

#include <indurop/result.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "config/model/io_config.h"

namespace indurop::config {

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

// The file of a device and the column of each of its points. Errors: the file cannot be read, what is wrong in it, or
// that it lacks columns.
struct CsvSource {
  CsvTable table;
  std::vector<std::size_t> columns;
};
Result<CsvSource, std::vector<base::Diagnostic>> read_csv_device(const IoDevice& device,
                                                                 std::span<const IoPoint> inputs);

}  // namespace indurop::config
