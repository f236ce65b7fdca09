// SPDX-License-Identifier: Apache-2.0
// Transports a Modbus request to its device and the answer back: over TCP, a serial line, or with serial frames over
// TCP, for gateways without Modbus of their own. Waits for the device.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "config/model/io_config.h"
#include "control/io/modbus_frame.h"

typedef struct _modbus modbus_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusLink {
 public:
  // Borrows the device.
  explicit ModbusLink(const config::IoDevice& device) : device_(device) {}

  // Returns why the link cannot be opened; empty on success.
  std::string open();
  void close() noexcept { context_.reset(); }
  [[nodiscard]] bool is_open() const noexcept { return context_ != nullptr; }

  // Sends the request and waits for the answer. Returns 0, or an error code of errno or libmodbus. `answer` is valid
  // until the next call.
  int ask(const ModbusFrame& frame, std::span<const std::uint8_t>& answer);

  // Returns true if the link still works after such an error and only this unit failed: the next request may be made.
  [[nodiscard]] bool survives(int error) const noexcept;

 private:
  struct Free {
    void operator()(modbus_t* context) const noexcept;
  };
  static constexpr std::size_t kMaxFrameBytes = 260;

  // Connects the context that was just made. Returns why it failed; empty on success.
  std::string connect(const std::string& where);
  [[nodiscard]] bool has_serial_frames() const noexcept;
  std::string open_tcp();
  std::string open_serial();
  bool send(const ModbusFrame& frame);
  void discard_late_answers() noexcept;
  // Returns the part of the received bytes from unit to data; empty if the envelope is wrong.
  [[nodiscard]] std::span<const std::uint8_t> unwrapped(std::size_t size) const noexcept;

  const config::IoDevice& device_;
  std::unique_ptr<modbus_t, Free> context_;
  std::array<std::uint8_t, kMaxFrameBytes> buffer_{};
  std::uint16_t transaction_ = 0;
};

}  // namespace indurop::io
