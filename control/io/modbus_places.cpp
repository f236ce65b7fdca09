// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_places.h"

#include <algorithm>
#include <limits>
#include <new>

#include <modbus/modbus.h>

#include "control/io/modbus_frame.h"
#include "control/io/modbus_plan.h"
#include "control/io/wire.h"

namespace indurop::io {
namespace {

using config::IoPoint;
using config::IoTable;

// Bytes of a request without its data, by function.
constexpr std::size_t kTwoWords = 5;
constexpr std::size_t kThreeWords = 7;
constexpr std::size_t kManyHead = 6;
constexpr std::size_t kExchangeHead = 10;

unsigned word_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
  return static_cast<unsigned>(bytes[at]) << kBitsPerByte | bytes[at + 1];
}

// First address and number of addresses of a table that the points cover.
struct Extent {
  unsigned first = 0;
  unsigned count = 0;
};

}  // namespace

void ModbusPlaces::Free::operator()(modbus_mapping_t* table) const noexcept {
  modbus_mapping_free(table);
}

ModbusPlaces::ModbusPlaces(std::span<const IoPoint> outputs, std::span<const IoPoint> inputs)
    : outputs_(outputs.begin(), outputs.end()),
      inputs_(inputs.begin(), inputs.end()),
      fresh_(outputs.size()),
      table_(table_of_points()) {}

std::unique_ptr<modbus_mapping_t, ModbusPlaces::Free> ModbusPlaces::table_of_points() const {
  const auto extent = [&](IoTable table) {
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t end = 0;
    for (const auto* points : {&outputs_, &inputs_}) {
      for (const IoPoint& point : *points) {
        if (point.address.table == table) {
          first = std::min<std::uint32_t>(first, point.address.number);
          end = std::max(end, end_of(point));
        }
      }
    }
    return end == 0 ? Extent{} : Extent{first, end - first};
  };
  const Extent coil = extent(IoTable::Coil);
  const Extent discrete = extent(IoTable::Discrete);
  const Extent holding = extent(IoTable::Holding);
  const Extent input = extent(IoTable::Input);
  std::unique_ptr<modbus_mapping_t, Free> table(modbus_mapping_new_start_address(
      coil.first, coil.count, discrete.first, discrete.count, holding.first, holding.count, input.first, input.count));
  if (table == nullptr) {
    throw std::bad_alloc();
  }
  return table;
}

void ModbusPlaces::offer(std::span<Sample> outputs) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const IoPoint& point = outputs_[i];
    fresh_[i] = outputs[i].quality == Quality::Good;
    if (!fresh_[i]) {
      continue;
    }
    const auto number = static_cast<std::ptrdiff_t>(point.address.number);
    if (config::is_bits(point.address.table)) {
      const bool coil = point.address.table == IoTable::Coil;
      std::uint8_t* bits = coil ? table_->tab_bits : table_->tab_input_bits;
      bits[number - (coil ? table_->start_bits : table_->start_input_bits)] = outputs[i].value != 0 ? 1 : 0;
      continue;
    }
    const bool holding = point.address.table == IoTable::Holding;
    std::uint16_t* registers = (holding ? table_->tab_registers : table_->tab_input_registers) +
                               (number - (holding ? table_->start_registers : table_->start_input_registers));
    if (point.address.bit >= 0) {
      const unsigned bit = 1U << static_cast<unsigned>(point.address.bit);
      const unsigned others = *registers & ~bit;
      *registers = static_cast<std::uint16_t>(others | (outputs[i].value != 0 ? bit : 0));
    } else if (!encode(form_of(point), outputs[i].value, std::span(registers, config::registers_of(point.type)))) {
      outputs[i].quality = Quality::OutOfRange;
    }
  }
}

ModbusPlaces::Access ModbusPlaces::access_of(std::span<const std::uint8_t> request) {
  constexpr Access kBadFunction{{}, {}, MODBUS_EXCEPTION_ILLEGAL_FUNCTION};
  constexpr Access kBadValue{{}, {}, MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE};
  if (request.empty()) {
    return kBadFunction;
  }
  const unsigned function = request[0];
  const std::size_t size = request.size();
  const auto range = [&](IoTable table, std::size_t at, bool one, std::uint32_t most) {
    const std::uint32_t count = one ? 1 : word_at(request, at + 2);
    return Range{table, word_at(request, at), count <= most ? count : 0};
  };
  const auto reading = [&](IoTable table, std::uint32_t most) -> Access {
    const Range asked = size == kTwoWords ? range(table, 1, false, most) : Range{};
    return asked.count > 0 ? Access{asked, {}, 0} : kBadValue;
  };
  const auto writing = [&](IoTable table, std::size_t wanted, bool one, std::uint32_t most) -> Access {
    const Range asked = size >= wanted && (size == wanted || !one) ? range(table, 1, one, most) : Range{};
    const std::size_t bytes =
        config::is_bits(table) ? (asked.count + kBitsPerByte - 1U) / kBitsPerByte : std::size_t{2} * asked.count;
    const bool whole = one || (size > wanted - 1 && request[wanted - 1] == bytes && size == wanted + bytes);
    return asked.count > 0 && whole ? Access{{}, asked, 0} : kBadValue;
  };
  switch (function) {
    case MODBUS_FC_READ_COILS:
      return reading(IoTable::Coil, kMaxReadBits);
    case MODBUS_FC_READ_DISCRETE_INPUTS:
      return reading(IoTable::Discrete, kMaxReadBits);
    case MODBUS_FC_READ_HOLDING_REGISTERS:
      return reading(IoTable::Holding, kMaxReadRegisters);
    case MODBUS_FC_READ_INPUT_REGISTERS:
      return reading(IoTable::Input, kMaxReadRegisters);
    case MODBUS_FC_WRITE_SINGLE_COIL: {
      const unsigned value = size == kTwoWords ? word_at(request, kTwoWords - 2) : 1;
      return value == 0 || value == kCoilOn ? writing(IoTable::Coil, kTwoWords, true, 1) : kBadValue;
    }
    case MODBUS_FC_WRITE_SINGLE_REGISTER:
      return writing(IoTable::Holding, kTwoWords, true, 1);
    case MODBUS_FC_WRITE_MULTIPLE_COILS:
      return writing(IoTable::Coil, kManyHead, false, kMaxWrittenBits);
    case MODBUS_FC_WRITE_MULTIPLE_REGISTERS:
      return writing(IoTable::Holding, kManyHead, false, kMaxWrittenRegisters);
    case MODBUS_FC_MASK_WRITE_REGISTER:
      return writing(IoTable::Holding, kThreeWords, true, 1);
    case MODBUS_FC_WRITE_AND_READ_REGISTERS: {
      if (size < kExchangeHead) {
        return kBadValue;
      }
      const Range read = range(IoTable::Holding, 1, false, kMaxReadRegisters);
      const Range write = range(IoTable::Holding, kTwoWords, false, kMaxExchangedRegisters);
      const std::size_t bytes = std::size_t{2} * write.count;
      const bool whole =
          read.count > 0 && write.count > 0 && request[kExchangeHead - 1] == bytes && size == kExchangeHead + bytes;
      return whole ? Access{read, write, 0} : kBadValue;
    }
    default:
      return kBadFunction;
  }
}

bool ModbusPlaces::overlaps(const IoPoint& point, const Range& range) noexcept {
  return point.address.table == range.table && point.address.number < range.first + range.count &&
         end_of(point) > range.first;
}

bool ModbusPlaces::covers(const Range& range, const IoPoint& point) noexcept {
  return point.address.number >= range.first && end_of(point) <= range.first + range.count;
}

bool ModbusPlaces::is_offered(const Range& range) const {
  const auto within = [&](int start, int count) {
    return range.first >= static_cast<std::uint32_t>(start) &&
           range.first + range.count <= static_cast<std::uint32_t>(start + count);
  };
  switch (range.table) {
    case IoTable::Coil:
      return within(table_->start_bits, table_->nb_bits);
    case IoTable::Discrete:
      return within(table_->start_input_bits, table_->nb_input_bits);
    case IoTable::Input:
      return within(table_->start_input_registers, table_->nb_input_registers);
    case IoTable::Holding:
      break;
  }
  return within(table_->start_registers, table_->nb_registers);
}

bool ModbusPlaces::is_stale(const Range& range) const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (!fresh_[i] && overlaps(outputs_[i], range)) {
      return true;
    }
  }
  return false;
}

// Returns true if each address belongs to an input and no input is written only in part.
bool ModbusPlaces::may_be_written(const Range& range) const {
  std::vector<bool> owned(range.count);
  for (const IoPoint& point : inputs_) {
    if (!overlaps(point, range)) {
      continue;
    }
    if (!covers(range, point)) {
      return false;
    }
    for (std::uint32_t at = point.address.number; at < end_of(point); ++at) {
      owned[at - range.first] = true;
    }
  }
  return std::all_of(owned.begin(), owned.end(), [](bool is) { return is; });
}

int ModbusPlaces::refusal(std::span<const std::uint8_t> request) const {
  const Access access = access_of(request);
  if (access.refusal != 0) {
    return access.refusal;
  }
  if ((access.read.count > 0 && !is_offered(access.read)) || !may_be_written(access.write)) {
    return MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS;
  }
  return is_stale(access.read) ? MODBUS_EXCEPTION_SLAVE_OR_SERVER_FAILURE : 0;
}

std::vector<std::size_t> ModbusPlaces::take(std::span<const std::uint8_t> request, std::span<Sample> inputs) const {
  std::vector<std::size_t> written;
  const Range range = access_of(request).write;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const IoPoint& point = inputs_[i];
    if (range.count == 0 || !overlaps(point, range)) {
      continue;
    }
    const auto number = static_cast<std::ptrdiff_t>(point.address.number);
    inputs[i].value =
        config::is_bits(point.address.table)
            ? table_->tab_bits[number - table_->start_bits]
            : value_in(point, std::span<const std::uint16_t>(table_->tab_registers + (number - table_->start_registers),
                                                             config::registers_of(point.type)));
    written.push_back(i);
  }
  return written;
}

}  // namespace indurop::io
