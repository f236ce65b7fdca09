// SPDX-License-Identifier: Apache-2.0
// Modbus TCP and RTU over libmodbus. Waits for its device, so only a thread of the device's own calls it.

#pragma once

#include <memory>
#include <vector>

#include "io/driver.h"
#include "io/modbus_plan.h"

typedef struct _modbus modbus_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusDriver final : public Driver {
 public:
  ModbusDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
               std::span<const config::IoPoint> inputs);

  [[nodiscard]] bool in_tick() const noexcept override { return false; }
  bool open() override;
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override;
  [[nodiscard]] std::string problem() const override { return problem_; }

 private:
  struct Free {
    void operator()(modbus_t* context) const noexcept;
  };
  enum class Reply { Good, Refused, Silent };

  // One request and its answer. Silent also for what is no answer.
  Reply write(const ModbusRequest& request, std::span<Sample> outputs);
  Reply read(const ModbusRequest& request, std::span<Sample> inputs);
  int write_registers(const ModbusRequest& request, std::span<Sample> outputs);
  int write_bits(const ModbusRequest& request, std::span<Sample> outputs);
  int read_table(const ModbusRequest& request);
  void read_values(const ModbusRequest& request, std::span<Sample> inputs);
  // One request over TCP; as libmodbus: below 0 if it failed, for the reason in errno.
  int over_tcp(const ModbusRequest& request, bool is_write);
  Reply judge(const ModbusRequest& request, bool is_write, int result);
  // True if the request may be made: its unit has not been silent in this exchange.
  [[nodiscard]] bool is_awake(const ModbusRequest& request) const;

  config::IoDevice device_;
  std::vector<config::IoPoint> outputs_;
  std::vector<config::IoPoint> inputs_;
  std::vector<ModbusRequest> writes_;
  std::vector<ModbusRequest> reads_;
  std::unique_ptr<modbus_t, Free> context_;
  std::vector<std::uint16_t> registers_;  // of one request
  std::vector<std::uint8_t> bits_;
  std::vector<int> silent_units_;  // of this exchange
  std::uint16_t transaction_ = 0;
  bool connection_lost_ = false;
  std::string problem_;
};

}  // namespace indurop::io
