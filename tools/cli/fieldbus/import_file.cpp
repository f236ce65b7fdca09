// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/fieldbus/import_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/xml/io_reader.h"
#include "core/base/duration.h"
#include "core/base/xml_text.h"

namespace indurop::tools {

namespace {

using EsiDevice = io::esi::Device;
using io::esi::InitCommand;
using io::esi::OpMode;

const OpMode* mode_of(const EsiDevice& device, const std::string& name) {
  const auto found = std::find_if(device.modes.begin(), device.modes.end(),
                                  [&name](const OpMode& mode) { return name.empty() || mode.name == name; });
  return found == device.modes.end() ? nullptr : &*found;
}

// A cycle that is given as a multiple or a part of another one.
std::chrono::nanoseconds cycle_of(std::int64_t ns, std::int32_t factor, std::chrono::nanoseconds other) {
  if (ns > 0) {
    return std::chrono::nanoseconds(ns);
  }
  return factor < 0 ? other / -static_cast<std::int64_t>(factor) : other * std::max(factor, 1);
}

// As a user writes it: 125us.
std::string duration_text(std::chrono::nanoseconds time) {
  std::string text = base::format_duration(time);
  std::erase(text, ' ');
  return text;
}

std::string comment(const std::string& text) {
  return text.empty() || text.find("--") != std::string::npos ? "" : fmt::format("  <!-- {} -->", base::xml_text(text));
}

bool is_mapping(std::uint16_t index) {
  return index >= 0x1600 && index < 0x1C40;
}

// Where the text goes on at this place, in bytes.
std::size_t offset_of(const std::string& xml, base::SourcePlace place) {
  std::size_t at = 0;
  for (int line = 1; line < place.line; ++line) {
    at = xml.find('\n', at) + 1;
  }
  for (int column = 1; column < place.column; ++at) {
    const bool is_next_first = (static_cast<unsigned char>(xml[at + 1]) & 0xC0U) != 0x80U;
    column += is_next_first ? 1 : 0;
  }
  return at;
}

// Puts lines at the beginning of the element that begins here.
void insert_children(std::string& xml, std::size_t element, const std::string& lines) {
  std::size_t at = element;
  for (char quote = 0; quote != 0 || xml[at] != '>'; ++at) {
    const char c = xml[at];
    if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    }
  }
  if (xml[at - 1] == '/') {
    xml.replace(at - 1, 2, fmt::format(">\n{}  </device>", lines));
  } else {
    xml.insert(at + 1, "\n" + lines.substr(0, lines.size() - 1));
  }
}

const EsiDevice* device_of(const config::IoDevice& device, const std::vector<EsiDevice>& known) {
  const EsiDevice* found = nullptr;
  for (const EsiDevice& one : known) {
    const auto& identity = one.sii.identity;
    const bool is_same = device.slave.vendor == identity.vendor && device.slave.product == identity.product;
    const bool is_exact = device.slave.revision == identity.revision;
    if (is_same && (found == nullptr || is_exact)) {
      found = &one;
    }
  }
  return found;
}

std::size_t next_slave(const config::IoConfig& config, const std::string& interface) {
  int next = 0;
  for (const config::IoDevice& device : config.devices) {
    if (device.driver == config::IoDriver::Ethercat && device.address == interface) {
      next = std::max(next, device.slave.position + 1);
    }
  }
  return static_cast<std::size_t>(next);
}

}  // namespace

std::string sync_text(const EsiDevice& device, const ImportChoice& choice) {
  const OpMode* const mode = mode_of(device, choice.mode);
  if (mode == nullptr || mode->assign_activate == 0) {
    return {};
  }
  constexpr unsigned kSync1 = 0x400;
  const auto cycle = cycle_of(mode->cycle0, mode->factor0, choice.cycle);
  std::string text =
      fmt::format("    <sync activate=\"0x{:x}\" cycle=\"{}\"", mode->assign_activate, duration_text(cycle));
  if (mode->shift0 > 0) {
    text += fmt::format(" shift=\"{}\"", duration_text(std::chrono::nanoseconds(mode->shift0)));
  }
  if ((mode->assign_activate & kSync1) != 0) {
    text += fmt::format(" sync1=\"{}\"", duration_text(cycle_of(mode->cycle1, mode->factor1, cycle)));
  }
  return text + "/>" + comment(mode->name + (mode->description.empty() ? "" : ": " + mode->description)) + "\n";
}

std::string set_text(const EsiDevice& device) {
  std::string text;
  for (const InitCommand& command : device.commands) {
    const auto& transitions = command.transitions;
    const std::size_t bytes = command.data.size();
    if (is_mapping(command.index)) {
      continue;
    }
    const std::string at = fmt::format("{:04x}:{:x}", command.index, command.subindex);
    const bool is_possible = std::find(transitions.begin(), transitions.end(), "PS") != transitions.end() &&
                             (bytes == 1 || bytes == 2 || bytes == 4) && !command.complete;
    if (!is_possible) {
      text +=
          "  " +
          comment(fmt::format("not possible as a set: {}, {} bytes at {}", at, bytes, fmt::join(transitions, " "))) +
          "\n";
      continue;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value |= std::uint64_t{command.data[i]} << (8U * i);
    }
    text += fmt::format("    <set at=\"{}\" type=\"uint{}\" value=\"{}\"/>{}\n", at, 8 * bytes, value,
                        comment(command.comment));
  }
  return text;
}

Result<ImportedFile, std::string> import_devices(const std::string& xml, const std::vector<EsiDevice>& known,
                                                 const ImportChoice& choice) {
  ImportedFile imported;
  imported.xml = xml.empty() ? kEmptyIoConfig : xml;
  const config::ReadIo present = config::read_io_config_text(imported.xml, "ioconfig.xml");
  // From the end on, so that places before stay what they are.
  for (auto device = present.config.devices.rbegin(); device != present.config.devices.rend(); ++device) {
    const EsiDevice* const described =
        device->driver == config::IoDriver::Ethercat ? device_of(*device, known) : nullptr;
    if (described == nullptr || device->slave.sync.activate != 0 || !device->slave.values.empty()) {
      continue;
    }
    if (const std::string lines = sync_text(*described, choice) + set_text(*described); !lines.empty()) {
      insert_children(imported.xml, offset_of(imported.xml, device->place), lines);
      ++imported.extended;
    }
  }
  DevicePlace place = choice.place;
  place.slave = next_slave(present.config, place.interface);
  for (const EsiDevice* const device : choice.added) {
    const std::string text = device_text(device->sii, place, sync_text(*device, choice) + set_text(*device));
    if (text.empty()) {
      return fmt::format("{} exchanges nothing at first; none of its PDOs has an Sm", device->type);
    }
    imported.xml.insert(imported.xml.rfind(kIoConfigEnd), text);
    ++imported.added;
    ++place.slave;
  }
  return imported;
}

}  // namespace indurop::tools
