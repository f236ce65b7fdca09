// SPDX-License-Identifier: Apache-2.0
// A CSV file of recorded values: the first row has names, the first column has times, and the cells are numbers or
// empty.

#pragma once

#include <indurop/result.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/model/io_config.h"
#include "core/base/diagnostic.h"

namespace indurop::config {

struct CsvRow {
  std::int64_t time_ns = 0;    // since the first row, strictly rising
  std::vector<double> values;  // in the order of CsvTable::columns; NaN: the cell is empty
};

struct CsvTable {
  std::vector<std::string> columns;  // without the time column
  std::vector<CsvRow> rows;
};

// Parses `text`. Cells are separated by ',' or ';', depending on the first row; a quoted cell may contain the
// separator. The first column is called time, time_s, time_ms, time_us or time_ns. Lines that are empty or begin with
// '#' are skipped. Errors: all errors in the text, with places in `file`, at most 20.
Result<CsvTable, std::vector<base::Diagnostic>> read_csv(std::string_view text, const std::string& file);

// The CSV file of a device, and the column of each of its points. Errors of read_csv_device(): the file cannot be read,
// its content is wrong, or columns are missing.
struct CsvSource {
  CsvTable table;
  std::vector<std::size_t> columns;
};
Result<CsvSource, std::vector<base::Diagnostic>> read_csv_device(const IoDevice& device,
                                                                 std::span<const IoPoint> inputs);

}  // namespace indurop::config
