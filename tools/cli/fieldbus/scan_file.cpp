// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/fieldbus/scan_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/xml_text.h"

namespace indurop::tools {

namespace {

using io::ethercat::Pdo;
using io::ethercat::PdoEntry;

constexpr std::uint16_t kControlword = 0x6040;
constexpr std::uint8_t kNotAssigned = 0xFF;

bool is_drive(const io::ethercat::Sii& sii) {
  return std::any_of(sii.outputs.begin(), sii.outputs.end(), [](const Pdo& pdo) {
    return pdo.sync_manager != kNotAssigned &&
           std::any_of(pdo.entries.begin(), pdo.entries.end(),
                       [](const PdoEntry& entry) { return entry.index == kControlword; });
  });
}

std::string points_of(const std::vector<Pdo>& pdos, std::string_view element, const std::string& variable) {
  std::string text;
  for (const Pdo& pdo : pdos) {
    for (const PdoEntry& entry : pdo.entries) {
      if (entry.index == 0 || pdo.sync_manager == kNotAssigned) {
        continue;
      }
      const std::string name = entry.name.empty() ? pdo.name : entry.name;
      text += fmt::format("    <{} variable=\"{}_{:04x}_{:x}\" at=\"{:04x}:{:x}\"/>{}\n", element, variable,
                          entry.index, entry.subindex, entry.index, entry.subindex,
                          name.empty() || name.find("--") != std::string::npos
                              ? ""
                              : fmt::format("  <!-- {} -->", base::xml_text(name)));
    }
  }
  return text;
}

}  // namespace

std::string device_text(const io::ethercat::Sii& sii, const DevicePlace& place, const std::string& children) {
  const std::string variable = fmt::format("{}::SLAVE{}", place.space, place.slave);
  const std::string device = fmt::format(
      "  <device name=\"slave{}\" driver=\"ethercat\" address=\"{}\" slave=\"{}\" vendor=\"0x{:x}\" "
      "product=\"0x{:x}\" revision=\"0x{:x}\"",
      place.slave, base::xml_text(place.interface), place.slave, sii.identity.vendor, sii.identity.product,
      sii.identity.revision);
  if (is_drive(sii)) {
    const std::string drive = fmt::format("{}\n          in=\"{}_IN\" out=\"{}_OUT\"", device, variable, variable);
    return children.empty() ? drive + "/>\n" : fmt::format("{}>\n{}  </device>\n", drive, children);
  }
  const std::string points = points_of(sii.inputs, "input", variable) + points_of(sii.outputs, "output", variable);
  return points.empty() ? "" : fmt::format("{}>\n{}{}  </device>\n", device, children, points);
}

std::string scan_file(const std::vector<io::ethercat::FoundSlave>& slaves, const std::string& interface,
                      const std::string& space) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ioconfig>\n";
  for (std::size_t place = 0; place < slaves.size(); ++place) {
    text += device_text(slaves[place].sii, {interface, place, space}, "");
  }
  return text + "</ioconfig>\n";
}

}  // namespace indurop::tools
