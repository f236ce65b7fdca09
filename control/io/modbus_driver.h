// SPDX-License-Identifier: Apache-2.0
// The client of a Modbus device. It waits for the device, so only the device's own thread calls it.

#pragma once

#include <vector>

#include "control/io/driver.h"
#include "control/io/modbus_link.h"
#include "control/io/modbus_plan.h"

namespace indurop::io {

class ModbusDriver final : public Driver {
 public:
  ModbusDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
               std::span<const config::IoPoint> inputs);

  [[nodiscard]] bool in_tick() const noexcept override { return false; }
  bool open() override;
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override { link_.close(); }
  [[nodiscard]] std::string problem() const override { return problem_; }

 private:
  enum class Reply { Good, Refused, Silent };
  struct Step {
    ModbusStep plan;
    Reply reply = Reply::Good;  // to the last request
  };

  [[nodiscard]] bool is_due(const Step& step) const noexcept;
  // Makes one request and evaluates its answer. An invalid answer counts as Silent.
  Reply make(const ModbusStep& step, bool writes, std::span<Sample> outputs);
  ModbusFrame frame_of(const ModbusStep& step, bool writes, std::span<Sample> outputs);
  void fill_bits(const ModbusRequest& request, std::span<const Sample> outputs);
  void fill_registers(const ModbusRequest& request, std::span<Sample> outputs);
  ModbusFrame masking(const ModbusRequest& request, std::span<const Sample> outputs) const;
  void take_values(const ModbusRequest& request, std::span<Sample> inputs);
  Reply judge(const ModbusRequest& request, bool is_write, int error);
  // Returns true if the request may be made: its unit has not been silent in this exchange.
  [[nodiscard]] bool is_awake(int unit) const;

  config::IoDevice device_;
  std::vector<config::IoPoint> outputs_;
  std::vector<config::IoPoint> inputs_;
  std::vector<Step> steps_;
  ModbusLink link_;
  std::vector<std::uint16_t> registers_;  // of one request
  std::vector<std::uint8_t> bits_;
  std::vector<int> silent_units_;  // in this exchange
  std::int64_t exchanges_ = 0;     // since the link was opened
  bool connection_lost_ = false;
  std::string problem_;
};

}  // namespace indurop::io
