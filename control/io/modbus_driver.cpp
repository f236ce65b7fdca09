// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include <modbus/modbus.h>

#include "control/io/wire.h"

namespace indurop::io {
namespace {

using config::IoPoint;

static_assert(kMaxReadRegisters == MODBUS_MAX_READ_REGISTERS && kMaxWrittenRegisters == MODBUS_MAX_WRITE_REGISTERS);
static_assert(kMaxReadBits == MODBUS_MAX_READ_BITS && kMaxWrittenBits == MODBUS_MAX_WRITE_BITS);
static_assert(kMaxExchangedRegisters == MODBUS_MAX_WR_WRITE_REGISTERS);

bool is_exception(int error) {
  return error > MODBUS_ENOBASE && error <= EMBXGTAR;
}
// The device answered that it has no such point.
bool is_refusal(int error) {
  return error == EMBXILFUN || error == EMBXILADD || error == EMBXILVAL;
}

void set_quality(const ModbusRequest& request, std::span<Sample> samples, Quality quality) {
  for (const std::size_t i : request.points) {
    samples[i].quality = quality;
  }
}

std::string places_of(const ModbusRequest& request) {
  return fmt::format("{} {}{}", config::name_of(request.table), request.first,
                     request.count > 1 ? fmt::format("..{}", request.first + request.count - 1) : "");
}

}  // namespace

ModbusDriver::ModbusDriver(const config::IoDevice& device, std::span<const IoPoint> outputs,
                           std::span<const IoPoint> inputs)
    : device_(device),
      outputs_(outputs.begin(), outputs.end()),
      inputs_(inputs.begin(), inputs.end()),
      link_(device_),
      registers_(MODBUS_MAX_READ_REGISTERS),
      bits_(MODBUS_MAX_READ_BITS) {
  for (ModbusStep& step : plan_steps(plan_writes(outputs_), plan_reads(inputs_, device.gap), device.together)) {
    steps_.push_back({std::move(step), Reply::Good});
  }
}

bool ModbusDriver::open() {
  exchanges_ = 0;
  problem_ = link_.open();
  if (problem_.empty()) {
    return true;
  }
  problem_ += "; trying again";
  return false;
}

bool ModbusDriver::is_awake(int unit) const {
  return std::find(silent_units_.begin(), silent_units_.end(), unit) == silent_units_.end();
}

bool ModbusDriver::is_due(const Step& step) const noexcept {
  return connection_lost_ || exchanges_ % std::max(step.plan.write.every, step.plan.read.every) == 0;
}

Driver::Outcome ModbusDriver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                       std::chrono::nanoseconds /*elapsed*/) {
  silent_units_.clear();
  connection_lost_ = !link_.is_open();
  bool all_good = true;
  for (Step& step : steps_) {
    const ModbusRequest& write = step.plan.write;
    const ModbusRequest& read = step.plan.read;
    // A request is sent only when all its values have been set at least once.
    const bool writes = write.count > 0 && std::all_of(write.points.begin(), write.points.end(), [&](std::size_t i) {
                          return outputs[i].quality == Quality::Good;
                        });
    if (!writes && read.count == 0) {
      continue;
    }
    if (is_due(step)) {
      step.reply = make(step.plan, writes, outputs);
      if (step.reply == Reply::Good) {
        take_values(read, inputs);
      }
    }
    if (step.reply != Reply::Good) {
      all_good = false;
      const Quality quality = step.reply == Reply::Refused ? Quality::Refused : Quality::Lost;
      set_quality(read, inputs, quality);
      if (writes) {
        set_quality(write, outputs, quality);
      }
    }
  }
  ++exchanges_;
  return connection_lost_ ? Outcome::Lost : all_good ? Outcome::Good : Outcome::Partly;
}

ModbusDriver::Reply ModbusDriver::make(const ModbusStep& step, bool writes, std::span<Sample> outputs) {
  const ModbusRequest& about = writes ? step.write : step.read;
  if (connection_lost_ || !is_awake(about.unit)) {
    return Reply::Silent;
  }
  const ModbusFrame frame = frame_of(step, writes, outputs);
  std::span<const std::uint8_t> answer;
  const int error = link_.ask(frame, answer);
  if (error == 0) {
    frame.take(answer, bits_, registers_);
    return Reply::Good;
  }
  return judge(about, writes, error);
}

ModbusFrame ModbusDriver::frame_of(const ModbusStep& step, bool writes, std::span<Sample> outputs) {
  if (!writes) {
    return ModbusFrame::reading(step.read);
  }
  if (step.write.masked) {
    return masking(step.write, outputs);
  }
  if (config::is_bits(step.write.table)) {
    fill_bits(step.write, outputs);
  } else {
    fill_registers(step.write, outputs);
  }
  return step.read.count > 0 ? ModbusFrame::exchanging(step.write, step.read, registers_)
                             : ModbusFrame::writing(step.write, bits_, registers_);
}

void ModbusDriver::fill_bits(const ModbusRequest& request, std::span<const Sample> outputs) {
  for (const std::size_t i : request.points) {
    bits_[outputs_[i].address.number - request.first] = outputs[i].value != 0 ? 1 : 0;
  }
}

void ModbusDriver::fill_registers(const ModbusRequest& request, std::span<Sample> outputs) {
  for (const std::size_t i : request.points) {
    const IoPoint& point = outputs_[i];
    const auto at =
        std::span(registers_).subspan(point.address.number - request.first, config::registers_of(point.type));
    if (!encode(form_of(point), outputs[i].value, at)) {
      outputs[i].quality = Quality::OutOfRange;
    }
  }
}

ModbusFrame ModbusDriver::masking(const ModbusRequest& request, std::span<const Sample> outputs) const {
  unsigned mask = 0;
  unsigned bits = 0;
  for (const std::size_t i : request.points) {
    const unsigned bit = 1U << static_cast<unsigned>(outputs_[i].address.bit);
    mask |= bit;
    bits |= outputs[i].value != 0 ? bit : 0;
  }
  return ModbusFrame::masking(request, static_cast<std::uint16_t>(mask), static_cast<std::uint16_t>(bits));
}

void ModbusDriver::take_values(const ModbusRequest& request, std::span<Sample> inputs) {
  for (const std::size_t i : request.points) {
    const IoPoint& point = inputs_[i];
    const std::size_t at = point.address.number - request.first;
    inputs[i].value = config::is_bits(request.table)
                          ? bits_[at]
                          : value_in(point, std::span(registers_).subspan(at, config::registers_of(point.type)));
    inputs[i].quality = Quality::Good;
  }
}

ModbusDriver::Reply ModbusDriver::judge(const ModbusRequest& request, bool is_write, int error) {
  problem_ = fmt::format("{} {} of unit {}: {}", is_write ? "writing" : "reading", places_of(request), request.unit,
                         error == ETIMEDOUT ? "no answer in time" : modbus_strerror(error));
  if (is_refusal(error)) {
    const bool unusual = error == EMBXILFUN && (request.masked || device_.together);
    problem_ += unusual ? "; the device cannot do this, see 'single bits' and 'together' in the documentation"
                        : "; the device has no such point, check its attribute at";
    return Reply::Refused;
  }
  problem_ += "; trying again";
  if (is_exception(error)) {
    return Reply::Silent;
  }
  if (link_.survives(error)) {
    silent_units_.push_back(request.unit);
  } else {
    connection_lost_ = true;
  }
  return Reply::Silent;
}

}  // namespace indurop::io
