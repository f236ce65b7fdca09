// SPDX-License-Identifier: Apache-2.0
// The coils and registers of a Modbus server, to which the points of the device are mapped. A client reads the values
// of outputs and the values that were written to inputs; it writes inputs, each only as a whole. No sockets.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "config/model/io_config.h"
#include "control/io/sample.h"

typedef struct _modbus_mapping_t modbus_mapping_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusPlaces {
 public:
  ModbusPlaces(std::span<const config::IoPoint> outputs, std::span<const config::IoPoint> inputs);

  // Sets the output values that clients read from now on. The quality of a value that does not fit becomes OutOfRange.
  void offer(std::span<Sample> outputs);

  // Returns the exception code of "MODBUS application protocol" 7 for a request (function and data); 0: it may be
  // answered from table(). Data outside of the points is never read as 0 or written.
  [[nodiscard]] int refusal(std::span<const std::uint8_t> request) const;
  [[nodiscard]] modbus_mapping_t& table() noexcept { return *table_; }

  // Call it after such a request was answered: sets the inputs it wrote, and returns their indices.
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
