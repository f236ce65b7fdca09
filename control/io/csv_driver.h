// SPDX-License-Identifier: Apache-2.0
// Recorded values instead of a device: each row of a CSV file is valid from its time until that of the next one.

#pragma once

#include <memory>
#include <vector>

#include "config/check/csv_table.h"
#include "control/io/driver.h"

namespace indurop::io {

class CsvDriver final : public Driver {
 public:
  // Errors: the file cannot be read, its content is wrong, or a column is missing.
  static Result<std::unique_ptr<CsvDriver>, std::vector<base::Diagnostic>> make(
      const config::IoDevice& device, std::span<const config::IoPoint> inputs);
  // `columns`: column of each point.
  CsvDriver(config::CsvTable table, std::vector<std::size_t> columns, bool loop);

  [[nodiscard]] bool in_tick() const noexcept override { return true; }
  bool open() override { return true; }
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override {}
  [[nodiscard]] std::string problem() const override { return {}; }

 private:
  config::CsvTable table_;
  std::vector<std::size_t> columns_;
  bool loop_;
  std::int64_t length_ns_;  // of one pass of the loop
  std::int64_t time_ns_ = 0;
  std::size_t row_ = 0;
  bool begun_ = false;
};

}  // namespace indurop::io
