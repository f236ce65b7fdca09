// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/registers.h"

#include <algorithm>
#include <array>

namespace indurop::io::ethercat {

namespace {

struct Region {
  std::uint16_t first;
  std::uint16_t end;
  std::string_view name;
};

constexpr std::array kRegions = {
    Region{0x0000, 0x0001, "type"},
    Region{0x0001, 0x0002, "revision"},
    Region{0x0002, 0x0004, "build"},
    Region{0x0004, 0x0005, "number of FMMUs"},
    Region{0x0005, 0x0006, "number of SyncManagers"},
    Region{0x0006, 0x0007, "RAM size"},
    Region{0x0007, 0x0008, "port descriptor"},
    Region{0x0008, 0x000A, "features"},
    Region{0x0010, 0x0012, "station address"},
    Region{0x0012, 0x0014, "station alias"},
    Region{0x0100, 0x0104, "DL control"},
    Region{0x0110, 0x0112, "DL status"},
    Region{0x0120, 0x0122, "AL control"},
    Region{0x0130, 0x0132, "AL status"},
    Region{0x0134, 0x0136, "AL status code"},
    Region{0x0140, 0x0142, "PDI control"},
    Region{0x0150, 0x0154, "PDI configuration"},
    Region{0x0200, 0x0202, "event mask"},
    Region{0x0204, 0x0208, "AL event mask"},
    Region{0x0210, 0x0212, "event request"},
    Region{0x0220, 0x0224, "AL event request"},
    Region{0x0300, 0x0308, "receive errors of the ports"},
    Region{0x0308, 0x030C, "forwarded receive errors"},
    Region{0x030C, 0x030D, "errors of the processing unit"},
    Region{0x030D, 0x030E, "errors of the PDI"},
    Region{0x0310, 0x0314, "lost links of the ports"},
    Region{0x0400, 0x0402, "watchdog divider"},
    Region{0x0410, 0x0412, "watchdog time of the PDI"},
    Region{0x0420, 0x0422, "watchdog time of process data"},
    Region{0x0440, 0x0442, "watchdog status of process data"},
    Region{0x0442, 0x0444, "watchdog counters"},
    Region{0x0500, 0x0502, "EEPROM configuration"},
    Region{0x0502, 0x0504, "EEPROM control"},
    Region{0x0504, 0x0508, "EEPROM address"},
    Region{0x0508, 0x0510, "EEPROM data"},
    Region{0x0510, 0x0518, "MII management"},
    Region{0x0600, 0x0700, "FMMU"},
    Region{0x0800, 0x0880, "SyncManager"},
    Region{0x0900, 0x0910, "receive times of the ports"},
    Region{0x0910, 0x0918, "system time"},
    Region{0x0918, 0x0920, "receive time of the processing unit"},
    Region{0x0920, 0x0928, "system time offset"},
    Region{0x0928, 0x092C, "system time delay"},
    Region{0x092C, 0x0930, "system time difference"},
    Region{0x0930, 0x0932, "speed counter start"},
    Region{0x0932, 0x0934, "speed counter difference"},
    Region{0x0934, 0x0936, "filter depths of the clock"},
    Region{0x0980, 0x0981, "cyclic unit control"},
    Region{0x0981, 0x0982, "SYNC activation"},
    Region{0x0982, 0x0984, "SYNC pulse length"},
    Region{0x0984, 0x0990, "SYNC status"},
    Region{0x0990, 0x0998, "SYNC0 start time"},
    Region{0x0998, 0x09A0, "SYNC1 next time"},
    Region{0x09A0, 0x09A4, "SYNC0 cycle time"},
    Region{0x09A4, 0x09A8, "SYNC1 cycle time"},
    Region{0x09A8, 0x09D0, "latch units"},
    Region{0x0F00, 0x0F10, "digital I/O"},
    Region{0x0F80, 0x1000, "user RAM"},
    Region{0x1000, 0xFFFF, "process data memory"},
};

struct CodeText {
  std::uint16_t code;
  std::string_view text;
};

constexpr std::array kCodes = {
    CodeText{0x0000, "no error"},
    CodeText{0x0001, "unspecified error"},
    CodeText{0x0002, "no memory"},
    CodeText{0x0003, "invalid device setup"},
    CodeText{0x0004, "invalid revision of the device"},
    CodeText{0x0006, "EEPROM does not fit the firmware"},
    CodeText{0x0007, "firmware update failed"},
    CodeText{0x000E, "license error"},
    CodeText{0x0011, "state change is invalid"},
    CodeText{0x0012, "requested state is unknown"},
    CodeText{0x0013, "bootstrap is not supported"},
    CodeText{0x0014, "no valid firmware"},
    CodeText{0x0015, "invalid mailbox configuration for bootstrap"},
    CodeText{0x0016, "invalid mailbox configuration"},
    CodeText{0x0017, "invalid SyncManager configuration"},
    CodeText{0x0018, "no valid inputs"},
    CodeText{0x0019, "no valid outputs"},
    CodeText{0x001A, "synchronization error"},
    CodeText{0x001B, "SyncManager watchdog: no outputs arrived in time"},
    CodeText{0x001C, "invalid SyncManager types"},
    CodeText{0x001D, "invalid output configuration"},
    CodeText{0x001E, "invalid input configuration"},
    CodeText{0x001F, "invalid watchdog configuration"},
    CodeText{0x0020, "slave needs a cold start"},
    CodeText{0x0021, "slave needs INIT"},
    CodeText{0x0022, "slave needs PREOP"},
    CodeText{0x0023, "slave needs SAFEOP"},
    CodeText{0x0024, "invalid mapping of inputs"},
    CodeText{0x0025, "invalid mapping of outputs"},
    CodeText{0x0026, "settings contradict each other"},
    CodeText{0x0027, "free run is not supported"},
    CodeText{0x0028, "synchronization is not supported"},
    CodeText{0x0029, "free run needs buffers of three"},
    CodeText{0x002A, "watchdog of the background"},
    CodeText{0x002B, "no valid inputs and outputs"},
    CodeText{0x002C, "fatal synchronization error: no SYNC0"},
    CodeText{0x002D, "no SYNC event arrived"},
    CodeText{0x0030, "invalid SYNC configuration of the distributed clock"},
    CodeText{0x0031, "invalid latch configuration of the distributed clock"},
    CodeText{0x0032, "distributed clock is not synchronized"},
    CodeText{0x0033, "SYNC signals do not agree with the process data"},
    CodeText{0x0034, "timeout of SYNC signals"},
    CodeText{0x0035, "invalid SYNC cycle time"},
    CodeText{0x0036, "SYNC0 cycle time does not fit the application"},
    CodeText{0x0037, "SYNC1 cycle time does not fit the application"},
    CodeText{0x0041, "mailbox error of AoE"},
    CodeText{0x0042, "mailbox error of EoE"},
    CodeText{0x0043, "mailbox error of CoE"},
    CodeText{0x0044, "mailbox error of FoE"},
    CodeText{0x0045, "mailbox error of SoE"},
    CodeText{0x004F, "mailbox error of the vendor's protocol"},
    CodeText{0x0050, "EEPROM access was refused"},
    CodeText{0x0051, "EEPROM error"},
    CodeText{0x0052, "hardware is not ready"},
    CodeText{0x0060, "slave was restarted on its own"},
    CodeText{0x0061, "identification of the device was changed"},
    CodeText{0x00F0, "application controller is available"},
};

}  // namespace

std::string_view register_name(std::uint16_t offset) noexcept {
  const auto* const found = std::find_if(kRegions.begin(), kRegions.end(), [offset](const Region& region) {
    return offset >= region.first && offset < region.end;
  });
  return found == kRegions.end() ? "register" : found->name;
}

std::string_view to_string(AlState state) noexcept {
  switch (state) {
    case AlState::None:
      return "no state";
    case AlState::Init:
      return "INIT";
    case AlState::PreOp:
      return "PREOP";
    case AlState::Boot:
      return "BOOT";
    case AlState::SafeOp:
      return "SAFEOP";
    case AlState::Op:
      return "OP";
  }
  return "unknown state";
}

std::string_view al_status_text(std::uint16_t code) noexcept {
  const auto* const found =
      std::find_if(kCodes.begin(), kCodes.end(), [code](const CodeText& known) { return known.code == code; });
  if (found != kCodes.end()) {
    return found->text;
  }
  return code >= 0x8000 ? "error of the vendor's own" : "reserved code";
}

}  // namespace indurop::io::ethercat
