// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_frame.h"

#include <algorithm>

namespace indurop::io {

namespace {

using config::IoTable;

// Function codes.
constexpr std::uint8_t kReadCoils = 1;
constexpr std::uint8_t kReadDiscrete = 2;
constexpr std::uint8_t kReadHolding = 3;
constexpr std::uint8_t kReadInput = 4;
constexpr std::uint8_t kWriteCoil = 5;
constexpr std::uint8_t kWriteRegister = 6;
constexpr std::uint8_t kWriteCoils = 15;
constexpr std::uint8_t kWriteRegisters = 16;
constexpr std::uint8_t kMaskRegister = 22;
constexpr std::uint8_t kExchangeRegisters = 23;
constexpr std::uint8_t kRefused = 0x80;  // added to the function

// Offsets in a request and in its answer.
constexpr std::size_t kUnit = 0;
constexpr std::size_t kFunction = 1;
constexpr std::size_t kFirst = 2;  // in an exception its code, in the answer to a read the number of bytes
constexpr std::size_t kData = 3;
constexpr std::size_t kAddressEnd = 4;
constexpr std::size_t kEcho = 6;
constexpr std::size_t kMaskEcho = 8;

std::uint8_t reading_function(IoTable table) noexcept {
  switch (table) {
    case IoTable::Coil:
      return kReadCoils;
    case IoTable::Discrete:
      return kReadDiscrete;
    case IoTable::Input:
      return kReadInput;
    case IoTable::Holding:
      break;
  }
  return kReadHolding;
}

std::uint8_t writing_function(IoTable table, bool one) noexcept {
  return table == IoTable::Coil ? (one ? kWriteCoil : kWriteCoils) : (one ? kWriteRegister : kWriteRegisters);
}

}  // namespace

void ModbusFrame::put_word(unsigned word) noexcept {
  put(word >> kBitsPerByte);
  put(word & kByteMask);
}

void ModbusFrame::put_registers(std::span<const std::uint16_t> registers) noexcept {
  put(2U * static_cast<unsigned>(registers.size()));
  for (const std::uint16_t word : registers) {
    put_word(word);
  }
}

ModbusFrame::ModbusFrame(int unit, std::uint8_t function) noexcept {
  put(static_cast<unsigned>(unit) & kByteMask);
  put(function);
}

void ModbusFrame::expect_values(const ModbusRequest& request) noexcept {
  bits_ = config::is_bits(request.table);
  count_ = request.count;
  answer_bytes_ = bits_ ? (request.count + kBitsPerByte - 1U) / kBitsPerByte : std::size_t{2} * request.count;
}

void ModbusFrame::expect_echo(std::size_t size, std::size_t same) noexcept {
  echo_size_ = size;
  echo_same_ = same;
}

ModbusFrame ModbusFrame::reading(const ModbusRequest& request) noexcept {
  ModbusFrame frame(request.unit, reading_function(request.table));
  frame.put_word(request.first);
  frame.put_word(request.count);
  frame.expect_values(request);
  return frame;
}

ModbusFrame ModbusFrame::writing(const ModbusRequest& request, std::span<const std::uint8_t> bits,
                                 std::span<const std::uint16_t> registers) noexcept {
  const bool one = request.count == 1;
  const bool is_bits = config::is_bits(request.table);
  ModbusFrame frame(request.unit, writing_function(request.table, one));
  frame.put_word(request.first);
  if (one) {
    frame.put_word(is_bits ? (bits[0] != 0 ? kCoilOn : 0) : registers[0]);
    // For a single value, only the address is certain to be returned.
    frame.expect_echo(kEcho, kAddressEnd);
    return frame;
  }
  frame.put_word(request.count);
  frame.expect_echo(kEcho, kEcho);
  if (!is_bits) {
    frame.put_registers(registers.first(request.count));
    return frame;
  }
  frame.put((request.count + kBitsPerByte - 1U) / kBitsPerByte);
  for (std::size_t i = 0; i < request.count; i += kBitsPerByte) {
    unsigned byte = 0;
    for (std::size_t k = i; k < std::min<std::size_t>(request.count, i + kBitsPerByte); ++k) {
      byte |= (bits[k] != 0 ? 1U : 0U) << (k - i);
    }
    frame.put(byte);
  }
  return frame;
}

ModbusFrame ModbusFrame::masking(const ModbusRequest& request, std::uint16_t mask, std::uint16_t bits) noexcept {
  ModbusFrame frame(request.unit, kMaskRegister);
  frame.put_word(request.first);
  frame.put_word(static_cast<std::uint16_t>(~mask));
  frame.put_word(static_cast<unsigned>(bits) & mask);
  frame.expect_echo(kMaskEcho, kMaskEcho);
  return frame;
}

ModbusFrame ModbusFrame::exchanging(const ModbusRequest& write, const ModbusRequest& read,
                                    std::span<const std::uint16_t> registers) noexcept {
  ModbusFrame frame(write.unit, kExchangeRegisters);
  frame.put_word(read.first);
  frame.put_word(read.count);
  frame.put_word(write.first);
  frame.put_word(write.count);
  frame.put_registers(registers.first(write.count));
  frame.expect_values(read);
  return frame;
}

ModbusFrame::Fit ModbusFrame::judge(std::span<const std::uint8_t> answer) const noexcept {
  if (answer.size() < kData) {
    return Fit::Garbage;
  }
  if (answer[kUnit] != bytes_[kUnit]) {
    return Fit::Stranger;
  }
  if (answer[kFunction] == (bytes_[kFunction] | kRefused)) {
    return answer.size() == kData ? Fit::Exception : Fit::Garbage;
  }
  if (answer[kFunction] != bytes_[kFunction]) {
    return Fit::Garbage;
  }
  if (answer_bytes_ > 0) {
    return answer[kFirst] == answer_bytes_ && answer.size() == kData + answer_bytes_ ? Fit::Answer : Fit::Garbage;
  }
  const bool same =
      answer.size() == echo_size_ &&
      std::equal(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(echo_same_), answer.begin());
  return same ? Fit::Answer : Fit::Garbage;
}

int ModbusFrame::exception(std::span<const std::uint8_t> answer) noexcept {
  return answer[kFirst];
}

void ModbusFrame::take(std::span<const std::uint8_t> answer, std::span<std::uint8_t> bits,
                       std::span<std::uint16_t> registers) const noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    if (bits_) {
      bits[i] =
          static_cast<std::uint8_t>(static_cast<unsigned>(answer[kData + i / kBitsPerByte]) >> (i % kBitsPerByte) & 1U);
    } else {
      registers[i] = static_cast<std::uint16_t>(static_cast<unsigned>(answer[kData + 2 * i]) << kBitsPerByte |
                                                answer[kData + 2 * i + 1]);
    }
  }
}

}  // namespace indurop::io
