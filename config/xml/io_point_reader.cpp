// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_point_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "config/xml/attributes.h"
#include "config/xml/element_rules.h"
#include "config/xml/io_object_reader.h"
#include "config/xml/io_opcua_reader.h"
#include "config/xml/values.h"
#include "core/base/duration.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr std::int64_t kRegisters = 65536;
constexpr std::array<IoTable, 4> kTables{IoTable::Coil, IoTable::Discrete, IoTable::Input, IoTable::Holding};
constexpr std::array<WireType, 9> kTypes{WireType::Bool,   WireType::Int16,   WireType::UInt16,
                                         WireType::Int32,  WireType::UInt32,  WireType::Int64,
                                         WireType::UInt64, WireType::Float32, WireType::Float64};
constexpr const char* kAddressForms = "write coil:3, discrete:0, input:10, holding:100 or holding:100.7 for one bit";

class PointReader {
 public:
  PointReader(const base::Element& element, const IoDevice& device, base::Diagnostics& report)
      : element_(element), device_(device), report_(report), attributes_(element, report) {}

  IoPoint read() {
    point_.place = element_.place;
    point_.output = element_.name == "output";
    point_.variable = attributes_.need("variable", "variable=\"PLC_ROBOT::I0\"", &point_.variable_place).value_or("");
    switch (device_.driver) {
      case IoDriver::ModbusTcp:
      case IoDriver::ModbusRtu:
        read_modbus();
        point_.unit = read_unit(attributes_, device_.driver).value_or(device_.unit);
        read_cycle();
        break;
      case IoDriver::ModbusServer:
        read_modbus();
        break;
      case IoDriver::Cia402:
      case IoDriver::Ethercat:
        read_object();
        break;
      case IoDriver::Csv:
        read_column();
        break;
      case IoDriver::Opcua:
        read_io_node(attributes_, point_, report_);
        break;
      case IoDriver::Fmu:
        point_.at = attributes_.need("at", "at=\"cylinder.position\"", &point_.at_place).value_or("");
        point_.type = WireType::Float64;
        break;
    }
    read_scaling();
    read_quality();
    if (is_leaf(element_, report_)) {
      check_no_text(element_, report_);
    }
    attributes_.finish(fmt::format("<{}> of driver {}", element_.name, name_of(device_.driver)));
    return std::move(point_);
  }

 private:
  void read_modbus() {
    const auto at = attributes_.need("at", "at=\"holding:100\"", &point_.at_place);
    point_.at = at.value_or("");
    const bool known = at && read_address(*at);
    std::vector<std::string> words;
    words.reserve(kTypes.size());
    for (const WireType type : kTypes) {
      words.emplace_back(name_of(type));
    }
    const auto type = attributes_.choose("type", words);
    const bool bits = is_bits(point_.address.table) || point_.address.bit >= 0;
    point_.type = type ? kTypes.at(*type) : bits ? WireType::Bool : WireType::UInt16;
    if (const auto order = attributes_.choose("order", {"abcd", "cdab", "badc", "dcba"})) {
      point_.swap_words = *order == 1 || *order == 3;
      point_.swap_bytes = *order >= 2;
    }
    if (known) {
      check_address(type.has_value());
    }
  }

  bool read_address(const std::string& text) {
    const std::size_t colon = text.find(':');
    const std::string word = text.substr(0, colon);
    const auto* table = std::find_if(kTables.begin(), kTables.end(), [&](IoTable t) { return word == name_of(t); });
    const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
    const std::size_t dot = rest.find('.');
    const auto number = read_integer(rest.substr(0, dot), 0, kRegisters - 1);
    const auto bit =
        dot == std::string::npos ? std::optional<std::int64_t>(-1) : read_integer(rest.substr(dot + 1), 0, 15);
    if (table == kTables.end() || !number || !bit) {
      report_.error(point_.at_place, fmt::format("at: {} is not an address of a Modbus device; {}",
                                                 base::in_quotes(text), kAddressForms));
      return false;
    }
    point_.address = {*table, static_cast<std::uint16_t>(*number), static_cast<int>(*bit)};
    return true;
  }

  void check_address(bool type_given) {
    const IoAddress& address = point_.address;
    if (is_bits(address.table) && address.bit >= 0) {
      report_.error(point_.at_place,
                    fmt::format("at: a {} is one bit already; leave out '.{}'", name_of(address.table), address.bit));
    } else if (type_given && point_.type != WireType::Bool && (is_bits(address.table) || address.bit >= 0)) {
      report_.error(element_.place,
                    fmt::format("type: one bit cannot be {}; write bool or leave it out", name_of(point_.type)));
    } else if (address.number + registers_of(point_.type) > kRegisters) {
      report_.error(point_.at_place, fmt::format("at: a {} does not fit at {} {}, the last is 65535",
                                                 name_of(point_.type), name_of(address.table), address.number));
    }
    // The client writes coils and holding registers of its server: this node its outputs, a panel the node's inputs.
    const bool written_over_the_wire = point_.output != (device_.driver == IoDriver::ModbusServer);
    if (written_over_the_wire && is_read_only(address.table)) {
      report_.error(point_.at_place, fmt::format("at: {} cannot be written; {} are coil or holding",
                                                 name_of(address.table), point_.output ? "outputs" : "inputs"));
    }
  }

  void read_cycle() {
    constexpr base::Nanos kMaxOfPoint{60 * 60'000'000'000};
    const auto cycle = attributes_.duration("cycle", base::Nanos{1}, kMaxOfPoint);
    if (!cycle) {
      return;
    }
    if (*cycle % device_.cycle != base::Nanos{0}) {
      report_.error(element_.place, fmt::format("cycle: {} is not a multiple of the device's cycle, {}; write one",
                                                base::format_duration(*cycle), base::format_duration(device_.cycle)));
      return;
    }
    point_.every = static_cast<int>(*cycle / device_.cycle);
  }

  void read_object() {
    const bool is_slave = device_.driver == IoDriver::Ethercat;
    const auto at =
        attributes_.need("at", is_slave ? "at=\"position\" or at=\"6064:0\"" : "at=\"position\"", &point_.at_place);
    point_.at = at.value_or("");
    std::vector<std::string> known;
    for (const AxisObject& object : kAxisObjects) {
      if (object.output == point_.output && (object.object.index != 0 || !is_slave)) {
        known.emplace_back(object.name);
        point_.object = object.name == point_.at ? object.object : point_.object;
      }
    }
    if (at && std::find(known.begin(), known.end(), *at) == known.end() &&
        !(is_slave && read_io_object(*at, point_.object))) {
      const std::string what =
          is_slave ? "a slave's object is 6064 or 7000:1, or a name of a drive's object; it has no" : "a drive has no";
      report_.error(point_.at_place, fmt::format("at: {} {} {}{}", what, point_.output ? "output" : "input",
                                                 base::in_quotes(*at), base::suggestion(*at, known)));
    }
    point_.type = WireType::Int32;
    if (is_slave) {
      read_io_type(attributes_, point_.object);
    }
  }

  void read_column() {
    point_.at_place = point_.variable_place;
    const std::size_t space = point_.variable.rfind("::");
    point_.at = attributes_.text("at", &point_.at_place)
                    .value_or(space == std::string::npos ? point_.variable : point_.variable.substr(space + 2));
    point_.type = WireType::Float64;
    if (point_.output) {
      report_.error(element_.place, "a csv device only has inputs; remove this <output>");
    }
  }

  void read_scaling() {
    point_.scale = attributes_.real("scale", -kAny, kAny).value_or(1);
    point_.offset = attributes_.real("offset", -kAny, kAny).value_or(0);
    if (point_.scale == 0) {
      report_.error(element_.place, "scale: 0 would lose the value; write 1 or leave it out");
      point_.scale = 1;
    }
    if (point_.type == WireType::Bool && (point_.scale != 1 || point_.offset != 0)) {
      report_.error(element_.place, "a bool has no scale and no offset; remove them, or give a type");
    }
  }

  void read_quality() {
    point_.quality = attributes_.text("quality", &point_.quality_place).value_or("");
    if (point_.output) {
      point_.stop = attributes_.real("stop", -kAny, kAny);
      if (point_.stop && device_.driver == IoDriver::Ethercat) {
        report_.error(element_.place,
                      "stop: an EtherCAT slave leaves OP when the node stops, and sets its outputs itself; remove it");
      } else if (point_.stop && device_.driver == IoDriver::Fmu) {
        report_.error(element_.place, "stop: an FMU ends with the node; remove it");
      }
      return;
    }
    base::SourcePlace place;
    const auto bad = attributes_.text("bad", &place);
    if (!bad || *bad == "hold") {
      return;
    }
    point_.bad_value = *bad == "zero" ? std::optional<double>(0) : read_real(*bad);
    if (!point_.bad_value) {
      report_.error(place, fmt::format("bad: {} is not possible; write hold, zero or a number", base::in_quotes(*bad)));
    }
  }

  const base::Element& element_;
  const IoDevice& device_;
  base::Diagnostics& report_;
  Attributes attributes_;
  IoPoint point_;
};

// The bits that a point occupies, to find overlaps; in bits, so that single bits of one register are distinct.
struct Span {
  std::uint32_t first;
  std::uint32_t end;
  const IoPoint* point;
};

Span span_of(const IoPoint& point) {
  constexpr std::uint32_t kBits = 16;
  const std::uint32_t first = point.address.number * kBits;
  if (point.address.bit >= 0) {
    const std::uint32_t bit = first + static_cast<std::uint32_t>(point.address.bit);
    return {bit, bit + 1, &point};
  }
  return {first, first + registers_of(point.type) * kBits, &point};
}

void check_overlaps(std::vector<Span>& spans, base::Diagnostics& report) {
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
  const Span* widest = nullptr;
  for (const Span& span : spans) {
    if (widest != nullptr && span.first < widest->end) {
      report.error(span.point->at_place, fmt::format("{} is written by the output in line {} already; one place has "
                                                     "one output",
                                                     base::in_quotes(span.point->at), widest->point->place.line));
    }
    if (widest == nullptr || span.end > widest->end) {
      widest = &span;
    }
  }
}

}  // namespace

std::string describe(const IoSlave& slave) {
  return slave.alias ? fmt::format("the slave with alias {}", *slave.alias) : fmt::format("slave {}", slave.position);
}

const char* name_of(IoDriver driver) noexcept {
  switch (driver) {
    case IoDriver::ModbusTcp:
      return "modbus_tcp";
    case IoDriver::ModbusRtu:
      return "modbus_rtu";
    case IoDriver::ModbusServer:
      return "modbus_server";
    case IoDriver::Cia402:
      return "cia402";
    case IoDriver::Ethercat:
      return "ethercat";
    case IoDriver::Csv:
      return "csv";
    case IoDriver::Opcua:
      return "opcua";
    case IoDriver::Fmu:
      return "fmu";
  }
  return "";
}

const char* name_of(WireType type) noexcept {
  switch (type) {
    case WireType::Bool:
      return "bool";
    case WireType::Int16:
      return "int16";
    case WireType::UInt16:
      return "uint16";
    case WireType::Int32:
      return "int32";
    case WireType::UInt32:
      return "uint32";
    case WireType::Int64:
      return "int64";
    case WireType::UInt64:
      return "uint64";
    case WireType::Float32:
      return "float32";
    case WireType::Float64:
      return "float64";
  }
  return "";
}

std::uint32_t registers_of(WireType type) noexcept {
  switch (type) {
    case WireType::Bool:
    case WireType::Int16:
    case WireType::UInt16:
      return 1;
    case WireType::Int32:
    case WireType::UInt32:
    case WireType::Float32:
      return 2;
    case WireType::Int64:
    case WireType::UInt64:
    case WireType::Float64:
      return 4;
  }
  return 1;
}

const char* name_of(IoTable table) noexcept {
  switch (table) {
    case IoTable::Coil:
      return "coil";
    case IoTable::Discrete:
      return "discrete";
    case IoTable::Input:
      return "input";
    case IoTable::Holding:
      return "holding";
  }
  return "";
}

std::optional<int> read_unit(Attributes& attributes, IoDriver driver) {
  constexpr std::int64_t kMaxOfPoint = 247;
  const bool serial = driver == IoDriver::ModbusRtu;
  const auto unit = attributes.integer("unit", serial ? 1 : 0, kMaxOfPoint);
  return unit ? std::optional(static_cast<int>(*unit)) : std::nullopt;
}

IoPoint read_io_point(const base::Element& element, const IoDevice& device, base::Diagnostics& report) {
  return PointReader(element, device, report).read();
}

void check_io_points(const IoDevice& device, base::Diagnostics& report) {
  if (device.driver == IoDriver::Csv || device.driver == IoDriver::Fmu) {
    return;
  }
  if (has_objects(device.driver) || device.driver == IoDriver::Opcua) {
    std::map<std::string, const IoPoint*> outputs;
    for (const IoPoint& point : device.points) {
      if (!point.output || point.at.empty()) {
        continue;
      }
      if (const auto [first, is_new] = outputs.try_emplace(point.at, &point); !is_new) {
        report.error(point.at_place, fmt::format("{} is written by the output in line {} already; one object has one "
                                                 "output",
                                                 base::in_quotes(point.at), first->second->place.line));
      }
    }
    return;
  }
  for (const IoTable table : {IoTable::Coil, IoTable::Discrete, IoTable::Input, IoTable::Holding}) {
    std::map<int, std::vector<Span>> spans;  // by unit
    for (const IoPoint& point : device.points) {
      if (point.output && point.address.table == table && !point.at.empty()) {
        spans[point.unit].push_back(span_of(point));
      }
    }
    for (auto& [unit, list] : spans) {
      check_overlaps(list, report);
    }
  }
}

}  // namespace indurop::config
