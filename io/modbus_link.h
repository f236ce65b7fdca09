// SPDX-License-Identifier: Apache-2.0
// The way of a Modbus request to its device and of the answer back: TCP, a serial line, or the frames of a serial line
// over TCP, as gateways without a Modbus of their own have them. Waits for the device.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "config/model/io_config.h"
#include "io/modbus_frame.h"

typedef struct _modbus modbus_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusLink {
 public:
  // Borrows the device.
  explicit ModbusLink(const config::IoDevice& device) : device_(device) {}

  // Empty, or why it cannot be opened.
  std::string open();
  void close() noexcept { context_.reset(); }
  [[nodiscard]] bool is_open() const noexcept { return context_ != nullptr; }

  // Sends the request and waits for what answers it. 0, or the reason as errno or libmodbus has it. `answer` is valid
  // until the next call.
  int ask(const ModbusFrame& frame, std::span<const std::uint8_t>& answer);

  // After such an error the link itself is fine, only this unit of several was not: the next request may be made.
  [[nodiscard]] bool survives(int error) const noexcept;

 private:
  struct Free {
    void operator()(modbus_t* context) const noexcept;
  };
  static constexpr std::size_t kMost = 260;

  // The context that was just made. Empty, or why not.
  std::string connect(const std::string& where);
  [[nodiscard]] bool has_serial_frames() const noexcept;
  std::string open_tcp();
  std::string open_serial();
  bool send(const ModbusFrame& frame);
  void discard_late_answers() noexcept;
  // What of the received is unit, function, data; empty if its envelope is wrong.
  [[nodiscard]] std::span<const std::uint8_t> unwrapped(std::size_t size) const noexcept;

  const config::IoDevice& device_;
  std::unique_ptr<modbus_t, Free> context_;
  std::array<std::uint8_t, kMost> buffer_{};
  std::uint16_t transaction_ = 0;
};

}  // namespace indurop::io
