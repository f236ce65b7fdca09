// SPDX-License-Identifier: Apache-2.0
#include "control/io/csv_driver.h"

#include <cmath>
#include <utility>

namespace indurop::io {

Result<std::unique_ptr<CsvDriver>, std::vector<base::Diagnostic>> CsvDriver::make(
    const config::IoDevice& device, std::span<const config::IoPoint> inputs) {
  auto source = config::read_csv_device(device, inputs);
  if (!source) {
    return std::move(source).error();
  }
  return std::make_unique<CsvDriver>(std::move(source->table), std::move(source->columns), device.csv.loop);
}

CsvDriver::CsvDriver(config::CsvTable table, std::vector<std::size_t> columns, bool loop)
    : table_(std::move(table)), columns_(std::move(columns)), loop_(loop && table_.rows.size() > 1) {
  // The last row is valid for as long as the one before it.
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
