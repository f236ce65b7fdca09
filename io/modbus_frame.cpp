// SPDX-License-Identifier: Apache-2.0
#include "io/modbus_frame.h"

#include <algorithm>

namespace indurop::io {

namespace {

using config::IoTable;

constexpr unsigned kByte = 8;
constexpr unsigned kByteMask = 0xFF;

// Function codes.
constexpr std::uint8_t kReadCoils = 1;
constexpr std::uint8_t kReadDiscrete = 2;
constexpr std::uint8_t kReadHolding = 3;
constexpr std::uint8_t kReadInput = 4;
constexpr std::uint8_t kWriteCoil = 5;
constexpr std::uint8_t kWriteRegister = 6;
constexpr std::uint8_t kWriteCoils = 15;
constexpr std::uint8_t kWriteRegisters = 16;
constexpr std::uint8_t kRefused = 0x80;  // added to the function
constexpr unsigned kOn = 0xFF00;

// Places in a frame.
constexpr std::size_t kLength = 4;
constexpr std::size_t kUnit = 6;
constexpr std::size_t kFunction = 7;
constexpr std::size_t kFirst = 8;  // of an exception its code, of a reading's answer the number of bytes
constexpr std::size_t kData = 9;
constexpr std::size_t kEcho = 12;

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
  put(word >> kByte);
  put(word & kByteMask);
}

ModbusFrame::ModbusFrame(std::uint16_t transaction, const ModbusRequest& request, std::uint8_t function) noexcept
    : count_(request.count), bits_(config::is_bits(request.table)) {
  put_word(transaction);
  put_word(0);  // protocol
  put_word(0);  // length
  put(static_cast<unsigned>(request.unit) & kByteMask);
  put(function);
  put_word(request.first);
}

// Once all bytes are there their number is known.
void ModbusFrame::close() noexcept {
  const std::size_t length = size_ - kUnit;
  bytes_[kLength] = static_cast<std::uint8_t>(length >> kByte);
  bytes_[kLength + 1] = static_cast<std::uint8_t>(length & kByteMask);
}

ModbusFrame ModbusFrame::reading(std::uint16_t transaction, const ModbusRequest& request) noexcept {
  ModbusFrame frame(transaction, request, reading_function(request.table));
  frame.put_word(request.count);
  frame.answer_bytes_ = frame.bits_ ? (request.count + kByte - 1U) / kByte : std::size_t{2} * request.count;
  frame.close();
  return frame;
}

ModbusFrame ModbusFrame::writing(std::uint16_t transaction, const ModbusRequest& request,
                                 std::span<const std::uint8_t> bits,
                                 std::span<const std::uint16_t> registers) noexcept {
  const bool one = request.count == 1;
  ModbusFrame frame(transaction, request, writing_function(request.table, one));
  if (one) {
    frame.put_word(frame.bits_ ? (bits[0] != 0 ? kOn : 0) : registers[0]);
    frame.close();
    return frame;
  }
  frame.put_word(request.count);
  if (frame.bits_) {
    frame.put((request.count + kByte - 1U) / kByte);
    for (std::size_t i = 0; i < request.count; i += kByte) {
      unsigned byte = 0;
      for (std::size_t k = i; k < std::min<std::size_t>(request.count, i + kByte); ++k) {
        byte |= (bits[k] != 0 ? 1U : 0U) << (k - i);
      }
      frame.put(byte);
    }
  } else {
    frame.put(2U * request.count);
    for (std::size_t i = 0; i < request.count; ++i) {
      frame.put_word(registers[i]);
    }
  }
  frame.close();
  return frame;
}

ModbusFrame::Fit ModbusFrame::judge(std::span<const std::uint8_t> answer) const noexcept {
  // Transaction and protocol come back as they were sent.
  if (answer.size() < kData || !std::equal(bytes_.begin(), bytes_.begin() + kLength, answer.begin())) {
    return Fit::Garbage;
  }
  if (answer[kUnit] != bytes_[kUnit]) {
    return Fit::Stranger;
  }
  if (answer[kFunction] == (bytes_[kFunction] | kRefused)) {
    return Fit::Exception;
  }
  if (answer[kFunction] != bytes_[kFunction]) {
    return Fit::Garbage;
  }
  if (answer_bytes_ > 0) {
    return answer[kFirst] == answer_bytes_ && answer.size() == kData + answer_bytes_ ? Fit::Answer : Fit::Garbage;
  }
  // Of one value only the address comes back for certain, of several their number as well.
  const std::size_t echo = count_ == 1 ? kEcho - 2 : kEcho;
  const bool same =
      answer.size() == kEcho &&
      std::equal(bytes_.begin() + kFirst, bytes_.begin() + static_cast<std::ptrdiff_t>(echo), answer.begin() + kFirst);
  return same ? Fit::Answer : Fit::Garbage;
}

int ModbusFrame::exception(std::span<const std::uint8_t> answer) noexcept {
  return answer[kFirst];
}

void ModbusFrame::take(std::span<const std::uint8_t> answer, std::span<std::uint8_t> bits,
                       std::span<std::uint16_t> registers) const noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    if (bits_) {
      bits[i] = static_cast<std::uint8_t>(static_cast<unsigned>(answer[kData + i / kByte]) >> (i % kByte) & 1U);
    } else {
      registers[i] =
          static_cast<std::uint16_t>(static_cast<unsigned>(answer[kData + 2 * i]) << kByte | answer[kData + 2 * i + 1]);
    }
  }
}

}  // namespace indurop::io
