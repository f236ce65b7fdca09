// SPDX-License-Identifier: Apache-2.0
// One Modbus request as the bytes that go over a TCP connection, and whether an answer belongs to it. libmodbus takes
// the answers of any unit for the one it asked.

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "io/modbus_plan.h"

namespace indurop::io {

class ModbusFrame {
 public:
  enum class Fit {
    Answer,     // to this request
    Exception,  // the device refuses it, exception() says why
    Stranger,   // another unit answers
    Garbage
  };

  // Reads what the request names.
  static ModbusFrame reading(std::uint16_t transaction, const ModbusRequest& request) noexcept;
  // Writes as many of these as the request counts; bits to coils, registers to holding registers.
  static ModbusFrame writing(std::uint16_t transaction, const ModbusRequest& request,
                             std::span<const std::uint8_t> bits, std::span<const std::uint16_t> registers) noexcept;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return std::span(bytes_).first(size_); }
  [[nodiscard]] Fit judge(std::span<const std::uint8_t> answer) const noexcept;
  // Code of an answer that is an Exception.
  static int exception(std::span<const std::uint8_t> answer) noexcept;
  // What an Answer to a reading holds.
  void take(std::span<const std::uint8_t> answer, std::span<std::uint8_t> bits,
            std::span<std::uint16_t> registers) const noexcept;

 private:
  static constexpr std::size_t kMost = 260;

  ModbusFrame(std::uint16_t transaction, const ModbusRequest& request, std::uint8_t function) noexcept;
  void put(unsigned byte) noexcept { bytes_[size_++] = static_cast<std::uint8_t>(byte); }
  void put_word(unsigned word) noexcept;
  void close() noexcept;

  std::array<std::uint8_t, kMost> bytes_{};
  std::size_t size_ = 0;
  std::uint16_t count_ = 0;
  std::size_t answer_bytes_ = 0;  // of data, when reading
  bool bits_ = false;
};

}  // namespace indurop::io
