// SPDX-License-Identifier: Apache-2.0
// Reads the root of ioconfig.xml and its devices.

#include "config/xml/io_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "config/xml/attributes.h"
#include "config/xml/document.h"
#include "config/xml/element_rules.h"
#include "config/xml/io_copy_reader.h"
#include "config/xml/io_file_reader.h"
#include "config/xml/io_homing_reader.h"
#include "config/xml/io_object_reader.h"
#include "config/xml/io_opcua_reader.h"
#include "config/xml/io_point_reader.h"
#include "config/xml/io_simulation_reader.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr DocumentKind kIoConfigXml{"ioconfig.xml", "<ioconfig> with one <device> per field device"};
constexpr std::array<IoDriver, 8> kDrivers{IoDriver::ModbusTcp, IoDriver::ModbusRtu, IoDriver::ModbusServer,
                                           IoDriver::Cia402,    IoDriver::Ethercat,  IoDriver::Csv,
                                           IoDriver::Opcua,     IoDriver::Fmu};
constexpr base::Nanos kMillisecond{1'000'000};
constexpr base::Nanos kOpcuaCycle{100 * kMillisecond};
constexpr base::Nanos kMinCycle{50'000};
constexpr base::Nanos kMaxSlaveCycle{50 * kMillisecond};  // half of the time in which slaves miss their master
constexpr base::Nanos kSecond{1'000'000'000};
constexpr base::Nanos kMinute{60 * kSecond};

bool is_modbus(IoDriver driver) {
  return driver == IoDriver::ModbusTcp || driver == IoDriver::ModbusRtu || driver == IoDriver::ModbusServer;
}

class DeviceReader {
 public:
  DeviceReader(const base::Element& element, const std::filesystem::path& folder, base::Diagnostics& report)
      : element_(element), folder_(folder), report_(report), attributes_(element, report) {}

  // Returns nothing if the driver is unknown, because it determines the meaning of everything else.
  std::optional<IoDevice> read() {
    device_.place = element_.place;
    if (!read_driver()) {
      return std::nullopt;
    }
    device_.name = attributes_.need("name", "name=\"conveyor\"").value_or("");
    device_.quality = attributes_.text("quality", &device_.quality_place).value_or("");
    device_.errors = attributes_.text("errors", &device_.errors_place).value_or("");
    switch (device_.driver) {
      case IoDriver::ModbusTcp:
        read_exchange();
        read_address("address=\"192.168.1.10:502\"", "192.168.1.10, plc.local:502 or [::1]:502");
        device_.framing =
            attributes_.choose("framing", {"tcp", "rtu"}).value_or(0) == 1 ? IoFraming::Rtu : IoFraming::Tcp;
        break;
      case IoDriver::ModbusRtu:
        read_rtu();
        break;
      case IoDriver::ModbusServer:
        read_server();
        break;
      case IoDriver::Cia402:
        read_axis();
        break;
      case IoDriver::Ethercat:
        read_slave();
        break;
      case IoDriver::Csv:
        read_io_csv(attributes_, folder_, device_.csv);
        break;
      case IoDriver::Fmu:
        read_io_fmu(attributes_, folder_, device_.fmu);
        break;
      case IoDriver::Opcua:
        device_.cycle = kOpcuaCycle;
        read_times();
        read_io_server(attributes_, device_, report_);
        break;
    }
    attributes_.finish(fmt::format("<device driver=\"{}\">", name_of(device_.driver)));
    check_no_text(element_, report_);
    for (const base::Element& child : element_.children) {
      const bool known = is_known(child, element_, children(), report_);
      if (known && child.name == "set" && device_.driver == IoDriver::Fmu) {
        read_io_start(child, device_.fmu, report_);
      } else if (known && child.name == "set") {
        read_io_value(child, device_, report_);
      } else if (known && child.name == "copy") {
        read_io_copy(child, device_, report_);
      } else if (known && child.name == "sync") {
        read_io_sync(child, device_, report_);
      } else if (known) {
        device_.points.push_back(read_io_point(child, device_, report_));
      }
    }
    check_io_points(device_, report_);
    return std::move(device_);
  }

 private:
  [[nodiscard]] std::vector<std::string> children() const {
    switch (device_.driver) {
      case IoDriver::Ethercat:
        return {"input", "output", "copy", "set", "sync"};
      case IoDriver::Fmu:
        return {"input", "output", "set"};
      default:
        return {"input", "output"};
    }
  }

  bool read_driver() {
    std::vector<std::string> words;
    words.reserve(kDrivers.size());
    for (const IoDriver driver : kDrivers) {
      words.emplace_back(name_of(driver));
    }
    if (!attributes_.need("driver", "driver=\"modbus_tcp\"")) {
      return false;
    }
    const auto driver = attributes_.choose("driver", words);
    device_.driver = driver ? kDrivers.at(*driver) : device_.driver;
    return driver.has_value();
  }

  void read_exchange() {
    constexpr std::int64_t kMaxGap = 100;
    device_.unit = read_unit(attributes_, device_.driver).value_or(device_.unit);
    device_.gap = static_cast<int>(attributes_.integer("gap", 0, kMaxGap).value_or(0));
    device_.together = attributes_.choose("together", {"off", "on"}).value_or(0) == 1;
    read_times();
  }

  // Of a device that is asked for its values.
  void read_times() {
    constexpr base::Nanos kMaxTimeout = 2 * kSecond;  // the node waits at most 3 s for its modules to stop
    device_.cycle = attributes_.duration("cycle", kMillisecond, kMinute).value_or(device_.cycle);
    device_.timeout = attributes_.duration("timeout", kMillisecond, kMaxTimeout).value_or(device_.timeout);
    device_.retry = attributes_.duration("retry", kMillisecond, kMinute).value_or(device_.retry);
    device_.retry_max = attributes_.duration("retry_most", device_.retry, 60 * kMinute)
                            .value_or(std::max(device_.retry, device_.retry_max));
    device_.watchdog = attributes_.duration("watchdog", kMillisecond, kMinute).value_or(device_.watchdog);
  }

  void read_server() {
    device_.unit = read_unit(attributes_, device_.driver).value_or(device_.unit);
    device_.cycle = attributes_.duration("cycle", kMillisecond, kMinute).value_or(device_.cycle);
    device_.timeout = attributes_.duration("timeout", kMillisecond, kMinute).value_or(2 * kSecond);
    device_.watchdog = attributes_.duration("watchdog", kMillisecond, kMinute).value_or(device_.watchdog);
    read_address("address=\"192.168.1.5:502\"", "192.168.1.5:502, or 0.0.0.0:502 for all networks of the board");
  }

  void read_address(const char* example, const char* forms) {
    base::SourcePlace place;
    const auto address = attributes_.need("address", example, &place);
    if (!address) {
      return;
    }
    // An IPv6 address with a port is written [::1]:502.
    const std::size_t bracket = address->rfind(']');
    const std::size_t colon = address->rfind(':');
    const bool has_port = colon != std::string::npos &&
                          (bracket == std::string::npos ? address->find(':') == colon : colon == bracket + 1);
    std::string host = has_port ? address->substr(0, colon) : *address;
    if (host.starts_with('[') && host.ends_with(']')) {
      host = host.substr(1, host.size() - 2);
    }
    constexpr std::int64_t kMaxPort = 65535;
    const auto port =
        has_port ? read_integer(address->substr(colon + 1), 1, kMaxPort) : std::optional<std::int64_t>(device_.port);
    if (host.empty() || host.find_first_of(" /") != std::string::npos || !port) {
      report_.error(place, fmt::format("address: {} is not an address; write {}", base::in_quotes(*address), forms));
      return;
    }
    device_.address = host;
    device_.port = static_cast<std::uint16_t>(*port);
  }

  void read_rtu() {
    device_.address = attributes_.need("address", "address=\"/dev/ttyUSB0\"").value_or("");
    read_exchange();
    const std::vector<std::string> bauds{"1200",  "2400",   "4800",   "9600",   "19200", "38400",
                                         "57600", "115200", "230400", "460800", "921600"};
    if (const auto baud = attributes_.choose("baud", bauds)) {
      device_.serial.baud = std::stoi(bauds[*baud]);
    }
    if (const auto parity = attributes_.choose("parity", {"none", "even", "odd"})) {
      device_.serial.parity = "NEO"[*parity];
    }
    device_.serial.stop_bits = static_cast<int>(attributes_.integer("stop_bits", 1, 2).value_or(1));
  }

  void real(const char* name, double low, double high, double& into) {
    into = attributes_.real(name, low, high).value_or(into);
  }

  void read_structs() {
    device_.axis.in = attributes_.text("in", &device_.axis.in_place).value_or("");
    device_.axis.out = attributes_.text("out", &device_.axis.out_place).value_or("");
  }

  // A number of an EEPROM: 0x4d8.
  std::optional<std::uint32_t> read_identity(const char* name) {
    base::SourcePlace place;
    const auto text = attributes_.text(name, &place);
    if (!text) {
      return std::nullopt;
    }
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
    const auto number = text->starts_with("0x") ? read_hex(text->substr(2), kMost) : std::nullopt;
    if (!number) {
      report_.error(place,
                    fmt::format("{}: {} is no number of an EEPROM; write it as 0x4d8", name, base::in_quotes(*text)));
    }
    return number;
  }

  void read_slave() {
    constexpr int kMaxSlaves = 1000;
    constexpr int kMaxAlias = std::numeric_limits<std::uint16_t>::max();
    device_.address = attributes_.need("address", "address=\"eth1\"").value_or("");
    base::SourcePlace place;
    if (attributes_.text("alias", &place)) {
      device_.slave.alias = static_cast<std::uint16_t>(attributes_.integer("alias", 1, kMaxAlias).value_or(0));
      if (attributes_.text("slave", &place)) {
        report_.error(place, "slave: the device is found by its alias; remove one of the two");
      }
    } else if (attributes_.need("slave", "slave=\"0\", or alias=\"5\"", &place)) {
      device_.slave.position = static_cast<int>(attributes_.integer("slave", 0, kMaxSlaves).value_or(0));
    }
    device_.slave.cycle = attributes_.duration("cycle", kMinCycle, kMaxSlaveCycle).value_or(base::Nanos{0});
    device_.cut = attributes_.text("cut", &device_.cut_place).value_or("");
    if (!device_.cut.empty() && device_.address.find(',') == std::string::npos) {
      report_.error(device_.cut_place,
                    fmt::format("cut: {} is no ring; name both of its interfaces, address=\"eth1,eth2\"",
                                base::in_quotes(device_.address)));
    }
    device_.cable_errors = attributes_.text("cable_errors", &device_.cable_errors_place).value_or("");
    device_.slave.vendor = read_identity("vendor");
    device_.slave.product = read_identity("product");
    device_.slave.revision = read_identity("revision");
    if (const auto file = attributes_.text("description", &device_.slave.description_place)) {
      device_.slave.description = (folder_ / *file).lexically_normal();
      device_.slave.description_as_written = *file;
    }
    read_structs();
  }

  void read_axis() {
    constexpr double kMaxReal = 1e12;
    constexpr double kLeast = 1e-9;
    IoAxis& axis = device_.axis;
    read_structs();
    real("counts", 4, std::numeric_limits<std::int32_t>::max(), axis.counts);
    real("inertia", kLeast, kMaxReal, axis.inertia);
    real("damping", 0, kMaxReal, axis.damping);
    real("torque", kLeast, kMaxReal, axis.torque);
    real("torque_bandwidth", 0, kMaxReal, axis.torque_bandwidth);
    real("speed", kLeast, kMaxReal, axis.speed);
    real("acceleration", kLeast, kMaxReal, axis.acceleration);
    constexpr double kMaxBandwidth = 200;  // the simulation's own step is 125 us
    real("bandwidth", 0.1, kMaxBandwidth, axis.bandwidth);
    real("following", kLeast, kMaxReal, axis.following);
    axis.following_time = attributes_.duration("following_time", base::Nanos{0}, kMinute).value_or(axis.following_time);
    constexpr double kMaxAngle = 1e6;
    real("start", -kMaxAngle, kMaxAngle, axis.start);
    real("mark", -kMaxAngle, kMaxAngle, axis.mark);
    real("home_speed", kLeast, kMaxReal, axis.home_speed);
    real("creep_speed", kLeast, kMaxReal, axis.creep_speed);
    real("torque_slope", kLeast, kMaxReal, axis.torque_slope);
    axis.low_limit = attributes_.real("low_limit", -kMaxAngle, kMaxAngle);
    axis.high_limit = attributes_.real("high_limit", -kMaxAngle, kMaxAngle);
    axis.home_from = attributes_.real("home_from", -kMaxAngle, kMaxAngle);
    axis.home_to = attributes_.real("home_to", -kMaxAngle, kMaxAngle);
    axis.probe = attributes_.real("probe", -kMaxAngle, kMaxAngle);
    axis.probe2 = attributes_.real("probe2", -kMaxAngle, kMaxAngle);
    read_io_homing(attributes_, device_, report_);
    real("noise", 0, kMaxReal, axis.noise);
    axis.seed = static_cast<std::uint64_t>(
        attributes_.integer("seed", 0, std::numeric_limits<std::int64_t>::max()).value_or(1));
  }

  const base::Element& element_;
  const std::filesystem::path& folder_;
  base::Diagnostics& report_;
  Attributes attributes_;
  IoDevice device_;
};

const char* example_points(IoDriver driver) {
  if (has_objects(driver)) {
    return R"(in="AXIS1_IN" and out="AXIS1_OUT", or <input>s and <output>s)";
  }
  if (driver == IoDriver::Opcua) {
    return R"(<input variable="..." at="ns=2;s=Temperature"/>)";
  }
  if (driver == IoDriver::Fmu) {
    return R"(variables="press", or <input variable="..." at="cylinder.position"/>)";
  }
  return is_modbus(driver) ? R"(<input variable="..." at="holding:0"/>)" : R"(<input variable="..." at="column"/>)";
}

// A slave from which others copy needs no points of its own.
void check_points(const IoDevice& device, const base::Element& element, base::Diagnostics& report) {
  if (element.children.empty() && device.axis.in.empty() && device.axis.out.empty() && device.slave.copied.empty() &&
      device.fmu.variables.empty()) {
    report.error(element.place, fmt::format("this device has no points; add {}", example_points(device.driver)));
  }
}

void interpret_io(const base::Element& root, IoConfig& config, base::Diagnostics& report) {
  if (root.name != "ioconfig") {
    report.error(root.place, fmt::format("the root element is <{}>, not the one of an {}: that is {}", root.name,
                                         kIoConfigXml.name, kIoConfigXml.form));
    return;
  }
  check_root_attributes(root, {}, report);
  check_no_text(root, report);
  std::map<std::string, int> lines;
  std::vector<const base::Element*> elements;  // of the devices
  for (const base::Element& child : root.children) {
    if (!is_known(child, root, {"device", "simulation"}, report)) {
      continue;
    }
    if (child.name == "simulation") {
      read_io_simulation(child, config, report);
      continue;
    }
    auto device = DeviceReader(child, config.file.parent_path(), report).read();
    if (!device) {
      continue;
    }
    elements.push_back(&child);
    check_io_slave(*device, config, report);
    const auto [first, is_new] = lines.try_emplace(device->name, device->place.line);
    if (!is_new && !device->name.empty()) {
      report.error(device->place, fmt::format("a second device {}, the first is in line {}; give each its own name",
                                              base::in_quotes(device->name), first->second));
    }
    config.devices.push_back(std::move(*device));
  }
  check_io_simulations(config, report);
  link_io_copies(config, report);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    check_points(config.devices[i], *elements[i], report);
  }
  if (root.children.empty()) {
    report.error(root.place, "<ioconfig> has no <device>; add one per field device");
  }
}

}  // namespace

ReadIo read_io_config(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file, kIoConfigXml);
  if (bytes) {
    return read_io_config_text(*bytes, file);
  }
  ReadIo result;
  result.config.file = file;
  result.diagnostics.push_back(bytes.error());
  return result;
}

ReadIo read_io_config_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  ReadIo result;
  result.config.file = pretend_file;
  if (const auto root = read_document(xml, pretend_file, kIoConfigXml, result.diagnostics)) {
    base::Diagnostics report(pretend_file.string(), result.diagnostics);
    interpret_io(*root, result.config, report);
    report.add_summary(result.diagnostics);
    base::sort_by_place(result.diagnostics);
  }
  return result;
}

}  // namespace indurop::config
