// SPDX-License-Identifier: Apache-2.0
// What clients of a Modbus server may read and write: the points of the device as coils and registers. A client reads
// what outputs hold and what was written to inputs; it writes inputs, each as a whole. No sockets.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "config/model/io_config.h"
#include "io/sample.h"

typedef struct _modbus_mapping_t modbus_mapping_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusPlaces {
 public:
  ModbusPlaces(std::span<const config::IoPoint> outputs, std::span<const config::IoPoint> inputs);

  // What clients read from now on. The quality of one that does not fit becomes OutOfRange.
  void offer(std::span<Sample> outputs);

  // The exception code of "MODBUS application protocol" 7 that such a request (function and data) gets; 0: it may be
  // answered from table(). No data outside of the points is read as 0 or written.
  [[nodiscard]] int refusal(std::span<const std::uint8_t> request) const;
  [[nodiscard]] modbus_mapping_t& table() noexcept { return *table_; }

  // Once such a request has been answered: gives the inputs it wrote their values, and names them.
  std::vector<std::size_t> take(std::span<const std::uint8_t> request, std::span<Sample> inputs) const;

 private:
  struct Free {
    void operator()(modbus_mapping_t* table) const noexcept;
  };
  struct Range {
    config::IoTable table = config::IoTable::Holding;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  struct Access {
    Range read;
    Range write;
    int refusal = 0;
  };
  static Access access_of(std::span<const std::uint8_t> request);
  static bool overlaps(const config::IoPoint& point, const Range& range) noexcept;
  static bool covers(const Range& range, const config::IoPoint& point) noexcept;
  [[nodiscard]] bool is_offered(const Range& range) const;
  [[nodiscard]] bool is_stale(const Range& range) const;
  [[nodiscard]] bool may_be_written(const Range& range) const;
  std::unique_ptr<modbus_mapping_t, Free> table_of_points() const;

  std::vector<config::IoPoint> outputs_;
  std::vector<config::IoPoint> inputs_;
  std::vector<bool> fresh_;  // of outputs
  std::unique_ptr<modbus_mapping_t, Free> table_;
};

}  // namespace indurop::io
