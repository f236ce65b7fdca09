// SPDX-License-Identifier: Apache-2.0
// A slave of an EtherCAT bus as a device of I/O dispatch: points are objects in its process data.

#pragma once

#include <memory>

#include "control/io/driver.h"
#include "control/io/ethercat_bus.h"

namespace indurop::io {

class EthercatDriver final : public Driver {
 public:
  EthercatDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
                 std::span<const config::IoPoint> inputs, Excludes excludes, std::shared_ptr<EthercatBus> bus);

  [[nodiscard]] bool in_tick() const noexcept override { return true; }
  bool open() override { return bus_->start(); }
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  [[nodiscard]] std::uint32_t cut() const noexcept override { return bus_->cut(); }
  [[nodiscard]] std::uint64_t cable_errors() const noexcept override { return cable_errors_; }
  void close() noexcept override { bus_->stop(); }
  [[nodiscard]] std::string problem() const override { return "the system has no thread for the bus"; }

 private:
  Outcome exchange(ethercat::Master& master, std::span<Sample> outputs, std::span<Sample> inputs) const noexcept;

  std::shared_ptr<EthercatBus> bus_;
  std::size_t member_;
  std::uint64_t cable_errors_ = 0;  // as of the last exchange
};

}  // namespace indurop::io
