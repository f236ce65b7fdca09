// SPDX-License-Identifier: Apache-2.0
// Descriptions of EtherCAT devices as their makers publish them (ESI, EtherCAT slave information): an XML file with one
// or many devices. What an EEPROM says of a device too becomes a Sii, so that the rest of the tree knows one form.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "control/io/ethercat/sii.h"
#include "core/base/diagnostic.h"

namespace indurop::io::esi {

// A way to use the distributed clock. Cycles and shifts in ns.
struct OpMode {
  std::string name;
  std::string description;
  std::uint16_t assign_activate = 0;  // 0: without pulses
  std::int64_t cycle0 = 0;            // of SYNC0; 0: that of the bus, times or divided by the factor
  std::int32_t factor0 = 0;           // below 0: divided
  std::int64_t shift0 = 0;
  std::int64_t cycle1 = 0;   // of SYNC1; 0: that of SYNC0 times the factor
  std::int32_t factor1 = 0;  // 0: there is no SYNC1
};

// An object that the maker wants to be set.
struct InitCommand {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  bool complete = false;
  std::vector<std::string> transitions;  // "PS": from PREOP to SAFEOP
  std::vector<std::uint8_t> data;
  std::string comment;
};

struct Device {
  base::SourcePlace place;
  std::string type;  // "EL2004"
  std::string vendor;
  ethercat::Sii sii;
  std::vector<OpMode> modes;
  std::vector<InitCommand> commands;
  bool has_modules = false;  // what it exchanges depends on modules, which are not read
};

struct EsiFile {
  std::vector<Device> devices;
  std::vector<base::Diagnostic> diagnostics;
  [[nodiscard]] bool ok() const noexcept { return !base::has_error(diagnostics); }
};

// Reports all errors of the file at once. Not real-time safe.
EsiFile read_esi(const std::filesystem::path& file);
EsiFile read_esi_text(std::string_view xml, const std::filesystem::path& pretend_file);

// The device of this type; of several, the one with the highest revision. Without a type: the only one. Null: none.
const Device* find_device(const EsiFile& esi, std::string_view type);
std::vector<std::string> types_of(const EsiFile& esi);

// The type name that CoE gives to this one of an ESI file, as a number; 0 if there is none.
std::uint8_t coe_type_of(std::string_view name) noexcept;

}  // namespace indurop::io::esi
