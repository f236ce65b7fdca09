// SPDX-License-Identifier: Apache-2.0
// One Modbus request as all transports carry it: unit, function, data; and whether an answer belongs to it. libmodbus
// takes the answers of any unit for the one it asked.

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "io/modbus_plan.h"

namespace indurop::io {

inline constexpr unsigned kBitsPerByte = 8;
inline constexpr unsigned kByteMask = 0xFF;
inline constexpr unsigned kCoilOn = 0xFF00;  // how a request writes one coil

class ModbusFrame {
 public:
  enum class Fit {
    Answer,     // to this request
    Exception,  // the device refuses it, exception() says why
    Stranger,   // another unit answers
    Garbage
  };

  // Reads what the request names.
  static ModbusFrame reading(const ModbusRequest& request) noexcept;
  // Writes as many of these as the request counts; bits to coils, registers to holding registers.
  static ModbusFrame writing(const ModbusRequest& request, std::span<const std::uint8_t> bits,
                             std::span<const std::uint16_t> registers) noexcept;
  // Function 22: of one holding register the bits of `mask` become those of `bits`, the others stay.
  static ModbusFrame masking(const ModbusRequest& request, std::uint16_t mask, std::uint16_t bits) noexcept;
  // Function 23: writes holding registers, then reads some, at once.
  static ModbusFrame exchanging(const ModbusRequest& write, const ModbusRequest& read,
                                std::span<const std::uint16_t> registers) noexcept;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return std::span(bytes_).first(size_); }
  // Of an answer from unit to data, as bytes().
  [[nodiscard]] Fit judge(std::span<const std::uint8_t> answer) const noexcept;
  // Code of an answer that is an Exception.
  static int exception(std::span<const std::uint8_t> answer) noexcept;
  // What an Answer to a reading holds.
  void take(std::span<const std::uint8_t> answer, std::span<std::uint8_t> bits,
            std::span<std::uint16_t> registers) const noexcept;

 private:
  static constexpr std::size_t kMost = 254;

  ModbusFrame(int unit, std::uint8_t function) noexcept;
  void put(unsigned byte) noexcept { bytes_[size_++] = static_cast<std::uint8_t>(byte); }
  void put_word(unsigned word) noexcept;
  void put_registers(std::span<const std::uint16_t> registers) noexcept;
  void expect_values(const ModbusRequest& request) noexcept;
  void expect_echo(std::size_t size, std::size_t same) noexcept;

  std::array<std::uint8_t, kMost> bytes_{};
  std::size_t size_ = 0;
  std::size_t count_ = 0;         // values to take, when reading
  std::size_t answer_bytes_ = 0;  // of data, when reading
  std::size_t echo_size_ = 0;     // of the answer, when not
  std::size_t echo_same_ = 0;     // of it come back as they were sent
  bool bits_ = false;
};

}  // namespace indurop::io
