// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_link.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include <modbus/modbus.h>

namespace indurop::io {
namespace {

using config::IoDriver;
using config::IoFraming;

constexpr int kDataBits = 8;
constexpr std::size_t kTcpHeader = 6;  // on TCP: transaction, protocol, length
constexpr std::size_t kCheck = 2;      // bytes of the checksum at the end of a serial frame

// CRC-16 of "MODBUS over serial line" 2.5.1.2.
std::uint16_t check_of(std::span<const std::uint8_t> bytes) noexcept {
  constexpr unsigned kPolynomial = 0xA001;
  unsigned check = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    check ^= byte;
    for (unsigned bit = 0; bit < kBitsPerByte; ++bit) {
      check = (check & 1U) != 0 ? check >> 1U ^ kPolynomial : check >> 1U;
    }
  }
  return static_cast<std::uint16_t>(check);
}

// Returns why a host has no address; empty if it has one. libmodbus would report this as a refused connection.
std::string name_problem(const std::string& host, const std::string& port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (error == 0) {
    ::freeaddrinfo(found);
    return {};
  }
  return fmt::format("{}: {}", host, ::gai_strerror(error));
}

void set_timeouts(modbus_t* context, std::chrono::nanoseconds timeout) {
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(timeout).count();
  constexpr std::int64_t kMicros = 1'000'000;
  modbus_set_response_timeout(context, static_cast<std::uint32_t>(micros / kMicros),
                              static_cast<std::uint32_t>(micros % kMicros));
  // No separate time-out for each byte: a device that sends bytes slowly must not delay the answer indefinitely.
  modbus_set_byte_timeout(context, 0, 0);
  modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE);
}

}  // namespace

void ModbusLink::Free::operator()(modbus_t* context) const noexcept {
  modbus_close(context);
  modbus_free(context);
}

std::string ModbusLink::open() {
  close();
  return device_.driver == IoDriver::ModbusTcp ? open_tcp() : open_serial();
}

std::string ModbusLink::connect(const std::string& where) {
  if (context_ == nullptr) {
    return modbus_strerror(errno);
  }
  set_timeouts(context_.get(), device_.timeout);
  if (modbus_connect(context_.get()) == 0) {
    return {};
  }
  const int error = errno;
  close();
  return fmt::format("cannot connect to {}: {}", where, modbus_strerror(error));
}

std::string ModbusLink::open_tcp() {
  const std::string port = std::to_string(device_.port);
  if (std::string problem = name_problem(device_.address, port); !problem.empty()) {
    return problem;
  }
  context_.reset(modbus_new_tcp_pi(device_.address.c_str(), port.c_str()));
  if (std::string problem = connect(device_.address + " port " + port);
      !problem.empty() || device_.framing == IoFraming::Tcp) {
    return problem;
  }
  // libmodbus reads serial frames from any descriptor; serial settings do not matter for a socket.
  modbus_t* serial = modbus_new_rtu("tcp", device_.serial.baud, device_.serial.parity, kDataBits, 1);
  if (serial == nullptr) {
    const int error = errno;
    close();
    return modbus_strerror(error);
  }
  set_timeouts(serial, device_.timeout);
  modbus_set_socket(serial, modbus_get_socket(context_.get()));
  modbus_free(context_.release());  // the connection stays open
  context_.reset(serial);
  return {};
}

std::string ModbusLink::open_serial() {
  const config::IoSerial& serial = device_.serial;
  context_.reset(modbus_new_rtu(device_.address.c_str(), serial.baud, serial.parity, kDataBits, serial.stop_bits));
  return connect(device_.address);
}

bool ModbusLink::has_serial_frames() const noexcept {
  return device_.driver == IoDriver::ModbusRtu || device_.framing == IoFraming::Rtu;
}

bool ModbusLink::survives(int error) const noexcept {
  // Over TCP, a late answer would be mistaken for the next one, so the connection is closed.
  return has_serial_frames() && (error == ETIMEDOUT || (error > EMBXGTAR && error <= EMBBADSLAVE));
}

bool ModbusLink::send(const ModbusFrame& frame) {
  const auto request = frame.bytes();
  if (device_.driver == IoDriver::ModbusRtu) {
    return modbus_send_raw_request(context_.get(), request.data(), static_cast<int>(request.size())) >= 0;
  }
  const bool serial = device_.framing == IoFraming::Rtu;
  std::size_t size = serial ? 0 : kTcpHeader;
  if (!serial) {
    ++transaction_;
    const std::array<unsigned, kTcpHeader> header{static_cast<unsigned>(transaction_) >> kBitsPerByte,
                                                  transaction_ & kByteMask,
                                                  0,
                                                  0,
                                                  static_cast<unsigned>(request.size()) >> kBitsPerByte,
                                                  static_cast<unsigned>(request.size()) & kByteMask};
    std::transform(header.begin(), header.end(), buffer_.begin(),
                   [](unsigned byte) { return static_cast<std::uint8_t>(byte); });
  }
  std::copy(request.begin(), request.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(size));
  size += request.size();
  if (serial) {
    const unsigned check = check_of(request);
    buffer_.at(size) = static_cast<std::uint8_t>(check & kByteMask);
    buffer_.at(size + 1) = static_cast<std::uint8_t>(check >> kBitsPerByte);
    size += kCheck;
  }
  const ssize_t sent = ::send(modbus_get_socket(context_.get()), buffer_.data(), size, MSG_NOSIGNAL);
  errno = sent < 0 ? errno : EAGAIN;
  return sent == static_cast<ssize_t>(size);
}

void ModbusLink::discard_late_answers() noexcept {
  if (device_.driver == IoDriver::ModbusRtu) {
    modbus_flush(context_.get());
    return;
  }
  while (::recv(modbus_get_socket(context_.get()), buffer_.data(), buffer_.size(), MSG_DONTWAIT) > 0) {
  }
}

std::span<const std::uint8_t> ModbusLink::unwrapped(std::size_t size) const noexcept {
  const auto whole = std::span<const std::uint8_t>(buffer_).first(size);
  if (has_serial_frames()) {
    return size < kCheck ? whole.first(0) : whole.first(size - kCheck);  // libmodbus has checked the checksum
  }
  const bool ours = size > kTcpHeader && whole[0] == transaction_ >> kBitsPerByte &&
                    whole[1] == (transaction_ & kByteMask) && whole[2] == 0 && whole[3] == 0;
  return ours ? whole.subspan(kTcpHeader) : whole.first(0);
}

int ModbusLink::ask(const ModbusFrame& frame, std::span<const std::uint8_t>& answer) {
  modbus_set_slave(context_.get(), frame.bytes()[0]);
  if (has_serial_frames()) {
    discard_late_answers();
  }
  if (!send(frame)) {
    return errno;
  }
  const int size = modbus_receive_confirmation(context_.get(), buffer_.data());
  if (size < 0) {
    return errno;
  }
  if (size == 0) {
    return EMBBADSLAVE;  // a serial frame of another unit
  }
  answer = unwrapped(static_cast<std::size_t>(size));
  switch (frame.judge(answer)) {
    case ModbusFrame::Fit::Answer:
      return 0;
    case ModbusFrame::Fit::Exception: {
      const int code = ModbusFrame::exception(answer);
      return code < MODBUS_EXCEPTION_MAX ? MODBUS_ENOBASE + code : EMBBADEXC;
    }
    case ModbusFrame::Fit::Stranger:
      return EMBBADSLAVE;
    case ModbusFrame::Fit::Garbage:
      break;
  }
  return EMBBADDATA;
}

}  // namespace indurop::io
