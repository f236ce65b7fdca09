// SPDX-License-Identifier: Apache-2.0
#include "control/io/slaves/slave_word.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "control/io/esi/esi_file.h"
#include "control/io/slaves/drive.h"
#include "control/io/slaves/terminal.h"
#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::io::slaves {

namespace {

using Model = Result<SlaveModel, std::string>;

constexpr std::string_view kDrive = "drive";

struct DriveValues {
  config::IoAxis axis;
  double alias = 0;
  double lrw = 1;
};
struct DriveValue {
  std::string_view name;
  double& (*of)(DriveValues& drive);
  double least;
  double most;
};
constexpr double kMaxReal = 1e9;
constexpr std::array<DriveValue, 8> kDriveValues{
    {{"start", [](DriveValues& drive) -> double& { return drive.axis.start; }, -1e6, kMaxReal},
     {"speed", [](DriveValues& drive) -> double& { return drive.axis.speed; }, 1e-9, kMaxReal},
     {"acceleration", [](DriveValues& drive) -> double& { return drive.axis.acceleration; }, 1e-9, kMaxReal},
     {"following", [](DriveValues& drive) -> double& { return drive.axis.following; }, 1e-9, kMaxReal},
     {"torque_bandwidth", [](DriveValues& drive) -> double& { return drive.axis.torque_bandwidth; }, 0, kMaxReal},
     {"counts", [](DriveValues& drive) -> double& { return drive.axis.counts; }, 4, kMaxReal},
     {"alias", [](DriveValues& drive) -> double& { return drive.alias; }, 1, 65535},
     {"lrw", [](DriveValues& drive) -> double& { return drive.lrw; }, 0, 1}}};

// Returns what is wrong with "start=-20".
std::string read_value(std::string_view part, DriveValues& drive) {
  const std::size_t equals = std::min(part.find('='), part.size());
  const std::string_view text = part.substr(std::min(equals + 1, part.size()));
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::vector<std::string> names;
  for (const DriveValue& known : kDriveValues) {
    names.emplace_back(known.name);
    if (known.name != part.substr(0, equals)) {
      continue;
    }
    if (error != std::errc() || end != text.data() + text.size() || !(number >= known.least && number <= known.most)) {
      return fmt::format("{} is no {} of a drive; write {}=220", base::in_quotes(text), known.name, known.name);
    }
    known.of(drive) = number;
    return {};
  }
  return fmt::format("a drive has no {}{}", base::in_quotes(part.substr(0, equals)),
                     base::suggestion(part.substr(0, equals), names));
}

Model drive_of(std::string_view values) {
  DriveValues wanted;
  while (!values.empty()) {
    const std::size_t comma = std::min(values.find(','), values.size());
    if (std::string wrong = read_value(values.substr(0, comma), wanted); !wrong.empty()) {
      return wrong;
    }
    values.remove_prefix(std::min(comma + 1, values.size()));
  }
  const auto drive = std::make_shared<Drive>(wanted.axis);
  ethercat::SlaveConfig config = Drive::slave(static_cast<std::uint16_t>(wanted.alias));
  if (wanted.lrw == 0) {
    config.esc.features |= ethercat::kNoLrw;
  }
  return SlaveModel{std::move(config), [drive](ethercat::Slave& slave) { drive->attach(slave); },
                    [drive](ethercat::Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now) {
                      drive->compute(outputs, inputs, now);
                    }};
}

Model terminal_of(ethercat::SlaveConfig config) {
  const auto terminal = std::make_shared<Terminal>();
  return SlaveModel{std::move(config), [terminal](ethercat::Slave& slave) { terminal->attach(slave); },
                    [terminal](ethercat::Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time /*now*/) {
                      terminal->compute(outputs, inputs);
                    }};
}

Model device_of_esi(const std::filesystem::path& file, const std::string& type) {
  const esi::EsiFile esi = esi::read_esi(file);
  if (!esi.ok()) {
    return "not a description of devices:\n" + base::to_text(esi.diagnostics);
  }
  const esi::Device* const found = esi::find_device(esi, type);
  if (found == nullptr) {
    return fmt::format("{}: {}", base::path_in_quotes(file.string()),
                       type.empty() ? fmt::format("it has {} devices; write which one, {}:{}", esi.devices.size(),
                                                  file.string(), esi.devices.empty() ? "" : esi.devices.front().type)
                                    : fmt::format("it has no device {}{}", base::in_quotes(type),
                                                  base::suggestion(type, esi::types_of(esi))));
  }
  return terminal_of(Terminal::slave(found->sii));
}

Model device_of_eeprom(const std::filesystem::path& file) {
  const auto image = base::read_file(file);
  if (!image) {
    return base::cannot_read(file, image.error()) +
           "; write 'drive', or a file with the EEPROM or the description (ESI) of a device";
  }
  std::vector<std::uint8_t> bytes(image->begin(), image->end());
  const auto sii = ethercat::read_sii(bytes);
  if (!sii) {
    return fmt::format("{}: this is no EEPROM of a slave: {}", base::path_in_quotes(file.string()), sii.error());
  }
  return terminal_of(Terminal::slave(*sii, std::move(bytes)));
}

// "1.3": port 3 of slave 1.
std::optional<ethercat::Segment::Outlet> outlet_of(std::string_view text) {
  ethercat::Segment::Outlet outlet;
  const char* const end = text.data() + text.size();
  const auto slave = std::from_chars(text.data(), end, outlet.slave);
  if (slave.ec != std::errc() || slave.ptr == end || *slave.ptr != '.') {
    return std::nullopt;
  }
  const auto port = std::from_chars(slave.ptr + 1, end, outlet.port);
  return port.ec == std::errc() && port.ptr == end ? std::optional(outlet) : std::nullopt;
}

Model device_of(const std::string& word, const std::filesystem::path& folder) {
  if (word == kDrive || word.starts_with("drive:")) {
    return drive_of(std::string_view(word).substr(std::min(kDrive.size() + 1, word.size())));
  }
  const std::size_t end = word.find(".xml");
  if (end == std::string::npos) {
    return device_of_eeprom(folder / word);
  }
  const std::size_t colon = word.find(':', end);
  return device_of_esi(folder / word.substr(0, colon), colon == std::string::npos ? "" : word.substr(colon + 1));
}

}  // namespace

Result<SlaveModel, std::string> read_slave_word(const std::string& word, const std::filesystem::path& folder) {
  const std::size_t at = word.rfind('@');
  if (at == std::string::npos || word.find('/', at) != std::string::npos) {
    return device_of(word, folder);
  }
  const auto outlet = outlet_of(std::string_view(word).substr(at + 1));
  if (!outlet) {
    return fmt::format("{} is no place on the cable; write drive@1.3 for a drive at port 3 of slave 1",
                       base::in_quotes(std::string_view(word).substr(at)));
  }
  auto model = device_of(word.substr(0, at), folder);
  if (model) {
    model->outlet = outlet;
  }
  return model;
}

std::string add_slave(ethercat::Segment& segment, SlaveModel model, std::function<ethercat::Time()> now) {
  auto application = [now = std::move(now), compute = std::move(model.compute)](
                         ethercat::Bytes outputs, std::span<std::uint8_t> inputs) { compute(outputs, inputs, now()); };
  if (!model.outlet) {
    model.attach(segment.add(std::move(model.config), std::move(application)));
    return {};
  }
  if (!segment.can_add(*model.outlet)) {
    return fmt::format(
        "slave {} cannot be at port {} of slave {}: the port has to be 1, 2 or 3 and free, and slaves are named in the "
        "order in which a frame passes them, which leaves each slave through its ports 3, 1 and 2; a ring has no "
        "branches",
        segment.size(), model.outlet->port, model.outlet->slave);
  }
  model.attach(segment.add(std::move(model.config), std::move(application), *model.outlet));
  return {};
}

}  // namespace indurop::io::slaves
