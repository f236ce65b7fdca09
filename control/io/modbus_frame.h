// SPDX-License-Identifier: Apache-2.0
// One Modbus request independent of the transport: unit, function, data; and the check whether an answer belongs to it.
// libmodbus itself accepts the answers of any unit.

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "control/io/modbus_plan.h"

namespace indurop::io {

inline constexpr unsigned kBitsPerByte = 8;
inline constexpr unsigned kByteMask = 0xFF;
inline constexpr unsigned kCoilOn = 0xFF00;  // value with which a request sets one coil

class ModbusFrame {
 public:
  enum class Fit {
    Answer,     // answers this request
    Exception,  // the device refuses the request, exception() returns the reason
    Stranger,   // another unit answers
    Garbage
  };

  // Makes a request that reads the values named by `request`.
  static ModbusFrame reading(const ModbusRequest& request) noexcept;
  // Makes a request that writes as many values as `request` counts; bits to coils, registers to holding registers.
  static ModbusFrame writing(const ModbusRequest& request, std::span<const std::uint8_t> bits,
                             std::span<const std::uint16_t> registers) noexcept;
  // Function 22: sets the bits of `mask` in one holding register to those of `bits`, and leaves the others unchanged.
  static ModbusFrame masking(const ModbusRequest& request, std::uint16_t mask, std::uint16_t bits) noexcept;
  // Function 23: writes holding registers, then reads some, in one request.
  static ModbusFrame exchanging(const ModbusRequest& write, const ModbusRequest& read,
                                std::span<const std::uint16_t> registers) noexcept;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return std::span(bytes_).first(size_); }
  // Checks an answer, given from unit to data, as bytes().
  [[nodiscard]] Fit judge(std::span<const std::uint8_t> answer) const noexcept;
  // Returns the code of an Exception answer.
  static int exception(std::span<const std::uint8_t> answer) noexcept;
  // Reads the values from the Answer to a read request.
  void take(std::span<const std::uint8_t> answer, std::span<std::uint8_t> bits,
            std::span<std::uint16_t> registers) const noexcept;

 private:
  static constexpr std::size_t kMaxFrameBytes = 254;

  ModbusFrame(int unit, std::uint8_t function) noexcept;
  void put(unsigned byte) noexcept { bytes_[size_++] = static_cast<std::uint8_t>(byte); }
  void put_word(unsigned word) noexcept;
  void put_registers(std::span<const std::uint16_t> registers) noexcept;
  void expect_values(const ModbusRequest& request) noexcept;
  void expect_echo(std::size_t size, std::size_t same) noexcept;

  std::array<std::uint8_t, kMaxFrameBytes> bytes_{};
  std::size_t size_ = 0;
  std::size_t count_ = 0;         // values to read
  std::size_t answer_bytes_ = 0;  // data bytes in the answer to a read request
  std::size_t echo_size_ = 0;     // bytes in the answer to a write request
  std::size_t echo_same_ = 0;     // of these, bytes that are returned as sent
  bool bits_ = false;
};

}  // namespace indurop::io
