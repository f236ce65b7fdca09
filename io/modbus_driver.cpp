// SPDX-License-Identifier: Apache-2.0
#include "io/modbus_driver.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include <modbus/modbus.h>

#include "io/modbus_frame.h"
#include "io/wire.h"

namespace indurop::io {
namespace {

using config::IoDriver;
using config::IoPoint;
using config::IoTable;

static_assert(kMostReadRegisters == MODBUS_MAX_READ_REGISTERS && kMostWrittenRegisters == MODBUS_MAX_WRITE_REGISTERS);
static_assert(kMostReadBits == MODBUS_MAX_READ_BITS && kMostWrittenBits == MODBUS_MAX_WRITE_BITS);

constexpr int kDataBits = 8;

bool is_exception(int error) {
  return error > MODBUS_ENOBASE && error <= EMBXGTAR;
}
// The device is there and says that it has no such point.
bool is_refusal(int error) {
  return error == EMBXILFUN || error == EMBXILADD || error == EMBXILVAL;
}

// Why a host has no address; empty if it has one. libmodbus would call that a refused connection.
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

WireForm form_of(const IoPoint& point) {
  return {point.type, point.swap_words, point.swap_bytes};
}

}  // namespace

void ModbusDriver::Free::operator()(modbus_t* context) const noexcept {
  modbus_close(context);
  modbus_free(context);
}

ModbusDriver::ModbusDriver(const config::IoDevice& device, std::span<const IoPoint> outputs,
                           std::span<const IoPoint> inputs)
    : device_(device),
      outputs_(outputs.begin(), outputs.end()),
      inputs_(inputs.begin(), inputs.end()),
      writes_(plan_writes(outputs)),
      reads_(plan_reads(inputs, device.gap)),
      registers_(MODBUS_MAX_READ_REGISTERS),
      bits_(MODBUS_MAX_READ_BITS) {}

bool ModbusDriver::open() {
  close();
  const std::string port = std::to_string(device_.port);
  if (device_.driver == IoDriver::ModbusTcp) {
    problem_ = name_problem(device_.address, port);
    if (!problem_.empty()) {
      return false;
    }
    context_.reset(modbus_new_tcp_pi(device_.address.c_str(), port.c_str()));
  } else {
    const config::IoSerial& serial = device_.serial;
    context_.reset(modbus_new_rtu(device_.address.c_str(), serial.baud, serial.parity, kDataBits, serial.stop_bits));
  }
  if (context_ == nullptr) {
    problem_ = modbus_strerror(errno);
    return false;
  }
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(device_.timeout).count();
  constexpr std::int64_t kMicros = 1'000'000;
  modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(micros / kMicros),
                              static_cast<std::uint32_t>(micros % kMicros));
  // No time-out of its own for each byte: a device that trickles bytes must not hold the answer up for ever.
  modbus_set_byte_timeout(context_.get(), 0, 0);
  modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  modbus_set_slave(context_.get(), device_.unit);
  if (modbus_connect(context_.get()) != 0) {
    problem_ = fmt::format("cannot connect to {}{}: {}", device_.address,
                           device_.driver == IoDriver::ModbusTcp ? " port " + port : "", modbus_strerror(errno));
    context_.reset();
    return false;
  }
  return true;
}

void ModbusDriver::close() noexcept {
  context_.reset();
}

bool ModbusDriver::is_awake(const ModbusRequest& request) const {
  return std::find(silent_units_.begin(), silent_units_.end(), request.unit) == silent_units_.end();
}

Driver::Outcome ModbusDriver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                       std::chrono::nanoseconds /*elapsed*/) {
  silent_units_.clear();
  connection_lost_ = context_ == nullptr;
  bool all_good = true;
  for (const ModbusRequest& request : writes_) {
    all_good = write(request, outputs) == Reply::Good && all_good;
  }
  for (const ModbusRequest& request : reads_) {
    all_good = read(request, inputs) == Reply::Good && all_good;
  }
  return connection_lost_ ? Outcome::Lost : all_good ? Outcome::Good : Outcome::Partly;
}

ModbusDriver::Reply ModbusDriver::judge(const ModbusRequest& request, bool is_write, int result) {
  const int error = errno;
  if (result >= 0) {
    return Reply::Good;
  }
  const std::string what = fmt::format(
      "{} {} {}{} of unit {}", is_write ? "writing" : "reading", config::name_of(request.table), request.first,
      request.count > 1 ? fmt::format("..{}", request.first + request.count - 1) : "", request.unit);
  problem_ = fmt::format("{}: {}{}", what, error == ETIMEDOUT ? "no answer in time" : modbus_strerror(error),
                         is_refusal(error) ? "; the device has no such point, check its at" : "");
  if (is_exception(error)) {
    return is_refusal(error) ? Reply::Refused : Reply::Silent;
  }
  const bool noise = error == ETIMEDOUT || (error > EMBXGTAR && error <= EMBBADSLAVE);
  if (device_.driver == IoDriver::ModbusRtu && noise) {
    // The line itself is fine. What still comes belongs to nobody.
    silent_units_.push_back(request.unit);
    modbus_flush(context_.get());
  } else {
    // A late answer would be taken for the next one, so the connection goes with it.
    connection_lost_ = true;
  }
  return Reply::Silent;
}

int ModbusDriver::over_tcp(const ModbusRequest& request, bool is_write) {
  ++transaction_;
  const ModbusFrame frame = is_write ? ModbusFrame::writing(transaction_, request, bits_, registers_)
                                     : ModbusFrame::reading(transaction_, request);
  const auto bytes = frame.bytes();
  const ssize_t sent = ::send(modbus_get_socket(context_.get()), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent != static_cast<ssize_t>(bytes.size())) {
    errno = sent < 0 ? errno : EAGAIN;
    return -1;
  }
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> buffer{};
  const int size = modbus_receive_confirmation(context_.get(), buffer.data());
  if (size < 0) {
    return -1;
  }
  const auto answer = std::span<const std::uint8_t>(buffer).first(static_cast<std::size_t>(size));
  switch (frame.judge(answer)) {
    case ModbusFrame::Fit::Answer:
      if (!is_write) {
        frame.take(answer, bits_, registers_);
      }
      return size;
    case ModbusFrame::Fit::Exception: {
      const int code = ModbusFrame::exception(answer);
      errno = code < MODBUS_EXCEPTION_MAX ? MODBUS_ENOBASE + code : EMBBADEXC;
      return -1;
    }
    case ModbusFrame::Fit::Stranger:
      errno = EMBBADSLAVE;
      return -1;
    case ModbusFrame::Fit::Garbage:
      break;
  }
  errno = EMBBADDATA;
  return -1;
}

int ModbusDriver::write_bits(const ModbusRequest& request, std::span<Sample> outputs) {
  for (const std::size_t i : request.points) {
    bits_[outputs_[i].address.number - request.first] = outputs[i].value != 0 ? 1 : 0;
  }
  if (device_.driver == IoDriver::ModbusTcp) {
    return over_tcp(request, true);
  }
  return request.count == 1 ? modbus_write_bit(context_.get(), request.first, bits_[0])
                            : modbus_write_bits(context_.get(), request.first, request.count, bits_.data());
}

int ModbusDriver::write_registers(const ModbusRequest& request, std::span<Sample> outputs) {
  for (const std::size_t i : request.points) {
    const IoPoint& point = outputs_[i];
    const auto at =
        std::span(registers_).subspan(point.address.number - request.first, config::registers_of(point.type));
    if (!encode(form_of(point), outputs[i].value, at)) {
      outputs[i].quality = Quality::OutOfRange;
    }
  }
  if (device_.driver == IoDriver::ModbusTcp) {
    return over_tcp(request, true);
  }
  return request.count == 1 ? modbus_write_register(context_.get(), request.first, registers_[0])
                            : modbus_write_registers(context_.get(), request.first, request.count, registers_.data());
}

ModbusDriver::Reply ModbusDriver::write(const ModbusRequest& request, std::span<Sample> outputs) {
  // Nothing is sent of a request before all of it was set once.
  const bool all_set = std::all_of(request.points.begin(), request.points.end(),
                                   [&](std::size_t i) { return outputs[i].quality == Quality::Good; });
  if (!all_set) {
    return Reply::Good;
  }
  Reply reply = Reply::Silent;
  if (!connection_lost_ && is_awake(request)) {
    modbus_set_slave(context_.get(), request.unit);
    reply = judge(request, true,
                  config::is_bits(request.table) ? write_bits(request, outputs) : write_registers(request, outputs));
  }
  for (const std::size_t i : request.points) {
    if (reply != Reply::Good) {
      outputs[i].quality = reply == Reply::Refused ? Quality::Refused : Quality::Lost;
    }
  }
  return reply;
}

void ModbusDriver::read_values(const ModbusRequest& request, std::span<Sample> inputs) {
  for (const std::size_t i : request.points) {
    const IoPoint& point = inputs_[i];
    const std::size_t at = point.address.number - request.first;
    if (config::is_bits(request.table)) {
      inputs[i].value = bits_[at];
    } else if (point.address.bit >= 0) {
      inputs[i].value = static_cast<unsigned>(registers_[at]) >> static_cast<unsigned>(point.address.bit) & 1U;
    } else {
      inputs[i].value = decode(form_of(point), std::span(registers_).subspan(at, config::registers_of(point.type)));
    }
    inputs[i].quality = Quality::Good;
  }
}

int ModbusDriver::read_table(const ModbusRequest& request) {
  if (device_.driver == IoDriver::ModbusTcp) {
    return over_tcp(request, false);
  }
  modbus_t* context = context_.get();
  modbus_set_slave(context, request.unit);
  switch (request.table) {
    case IoTable::Coil:
      return modbus_read_bits(context, request.first, request.count, bits_.data());
    case IoTable::Discrete:
      return modbus_read_input_bits(context, request.first, request.count, bits_.data());
    case IoTable::Input:
      return modbus_read_input_registers(context, request.first, request.count, registers_.data());
    case IoTable::Holding:
      return modbus_read_registers(context, request.first, request.count, registers_.data());
  }
  return -1;
}

ModbusDriver::Reply ModbusDriver::read(const ModbusRequest& request, std::span<Sample> inputs) {
  Reply reply = Reply::Silent;
  if (!connection_lost_ && is_awake(request)) {
    reply = judge(request, false, read_table(request));
  }
  if (reply == Reply::Good) {
    read_values(request, inputs);
    return reply;
  }
  for (const std::size_t i : request.points) {
    inputs[i].quality = reply == Reply::Refused ? Quality::Refused : Quality::Lost;
  }
  return reply;
}

}  // namespace indurop::io
