// SPDX-License-Identifier: Apache-2.0
// What makers say of their devices (ESI) as devices of an ioconfig.xml: new ones, and what is missing in those that are
// there.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "control/io/esi/esi_file.h"
#include "tools/cli/fieldbus/scan_file.h"

namespace indurop::tools {

// A file without devices; new ones go before its end.
inline constexpr const char* kEmptyIoConfig = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ioconfig>\n</ioconfig>\n";
inline constexpr std::string_view kIoConfigEnd = "</ioconfig>";

struct ImportChoice {
  std::vector<const io::esi::Device*> added;  // in the order of the cable, after those that are there
  std::string mode;                           // of the clocks (OpMode), by name; empty: the first of the device
  std::chrono::nanoseconds cycle{1'000'000};  // of the bus
  DevicePlace place;                          // `slave` counts on from there
};

// The <sync> of a device in this OpMode; empty if it has no pulses, or no such mode.
std::string sync_text(const io::esi::Device& device, const ImportChoice& choice);
// <set>s for what the maker wants to be set on the way to SAFEOP. Mapping is left out: points decide it.
std::string set_text(const io::esi::Device& device);

struct ImportedFile {
  std::string xml;
  std::size_t added = 0;
  std::size_t extended = 0;
};
// Adds to the text of an ioconfig.xml, which has no errors: the chosen devices at its end, and <sync> and <set>s in
// devices with the identity of one that is known and with no <sync> and <set> of their own. Errors: a chosen device
// exchanges nothing.
Result<ImportedFile, std::string> import_devices(const std::string& xml, const std::vector<io::esi::Device>& known,
                                                 const ImportChoice& choice);

}  // namespace indurop::tools
