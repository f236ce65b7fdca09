// SPDX-License-Identifier: Apache-2.0
#include "io/csv_driver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/read_file.h"

namespace indurop::io {

Result<std::unique_ptr<CsvDriver>, std::vector<base::Diagnostic>> CsvDriver::make(
    const config::IoDevice& device, std::span<const config::IoPoint> inputs) {
  const auto problem = [&device](base::SourcePlace place, std::string what) {
    return std::vector{
        base::Diagnostic{base::Diagnostic::Severity::Error, device.csv.file.string(), place, std::move(what)}};
  };
  const std::string file = device.csv.file.string();
  const auto text = base::read_file(file);
  if (!text) {
    return problem({}, fmt::format("cannot be read: {}", text.error().text));
  }
  auto table = read_csv(*text, file);
  if (!table) {
    return std::move(table).error();
  }
  std::vector<std::size_t> columns;
  for (const config::IoPoint& point : inputs) {
    const auto found = std::find(table->columns.begin(), table->columns.end(), point.at);
    if (found == table->columns.end()) {
      return problem({1, 1},
                     fmt::format("there is no column '{}'; there are {}", point.at, fmt::join(table->columns, ", ")));
    }
    columns.push_back(static_cast<std::size_t>(found - table->columns.begin()));
  }
  return std::make_unique<CsvDriver>(std::move(table).value(), std::move(columns), device.csv.loop);
}

CsvDriver::CsvDriver(CsvTable table, std::vector<std::size_t> columns, bool loop)
    : table_(std::move(table)), columns_(std::move(columns)), loop_(loop && table_.rows.size() > 1) {
  // The last row lasts as long as the one before it.
  const auto& rows = table_.rows;
  length_ns_ = loop_ ? 2 * rows.back().time_ns - rows[rows.size() - 2].time_ns : 0;
}

Driver::Outcome CsvDriver::exchange(std::span<Sample> /*outputs*/, std::span<Sample> inputs,
                                    std::chrono::nanoseconds elapsed) {
  time_ns_ += std::exchange(begun_, true) ? elapsed.count() : 0;
  const auto& rows = table_.rows;
  if (loop_ && time_ns_ >= length_ns_) {
    time_ns_ %= length_ns_;
    row_ = 0;
  }
  while (row_ + 1 < rows.size() && rows[row_ + 1].time_ns <= time_ns_) {
    ++row_;
  }
  const bool before_first = time_ns_ < rows.front().time_ns;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double value = rows[row_].values[columns_[i]];
    if (before_first || std::isnan(value)) {
      inputs[i].quality = before_first ? Quality::None : Quality::Lost;
      continue;
    }
    inputs[i].value = static_cast<Number>(value);
    inputs[i].quality = Quality::Good;
  }
  return Outcome::Good;
}

}  // namespace indurop::io
