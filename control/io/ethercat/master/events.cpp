// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/events.h"

#include <fmt/format.h>

#include "control/io/ethercat/coe.h"

namespace indurop::io::ethercat {

namespace {

std::string words(const Event& event) {
  switch (event.problem) {
    case Problem::None:
      return "operates";
    case Problem::Missing:
      return "does not answer; check its power and the cable before it";
    case Problem::Moved:
      return fmt::format(
          "station {:04x}h answers at its position; it or a slave before it is missing, or one was added",
          event.detail);
    case Problem::WrongIdentity:
      return fmt::format("another device is at its position: product code {:08x}h", event.detail);
    case Problem::WrongAlias:
      return fmt::format("another device is at its position: alias {}", event.detail);
    case Problem::EepromBusy:
      return "its EEPROM does not answer";
    case Problem::StateRefused:
      return fmt::format("refused a state: {} ({:04x}h)", al_status_text(static_cast<std::uint16_t>(event.detail)),
                         event.detail);
    case Problem::StateTimeout:
      return fmt::format("did not reach {} in time", to_string(static_cast<AlState>(event.detail)));
    case Problem::StateLost:
      return fmt::format("left OP: {} ({:04x}h)", al_status_text(static_cast<std::uint16_t>(event.detail)),
                         event.detail);
    case Problem::SdoAborted:
      return fmt::format("refused object {:04x}:{:02x}: {} ({:08x}h)", event.object >> 8U, event.object & 0xFFU,
                         sdo_abort_text(event.detail), event.detail);
    case Problem::SdoTimeout:
      return fmt::format("did not answer for object {:04x}h", event.detail);
    case Problem::WrongCounter:
      return fmt::format("wrong working counter {}", event.detail);
    case Problem::NoClock:
      return "has no distributed clock, and the file wants pulses of it; remove <sync>";
    case Problem::NoLrw:
      return "does not support LRW, unlike the slave that was there before; start the node again";
    case Problem::BrokenFrames:
      return fmt::format("port {} received {} broken frames within a second; check the cable and the plug there",
                         event.detail >> 16U, event.detail & 0xFFFFU);
    case Problem::LostLink:
      return fmt::format("port {} lost its link {} times within a second; check the cable and the plug there",
                         event.detail >> 16U, event.detail & 0xFFFFU);
    case Problem::CopyBegun:
      return fmt::format("gets what is copied from slave {}", event.detail);
    case Problem::CopyLost:
      return fmt::format("slave {} has no valid bytes to copy to it; these outputs have their fail-safe values",
                         event.detail);
    case Problem::ClockNotInStep:
      return fmt::format("its clock does not follow the reference clock: {} ns ahead of it",
                         static_cast<std::int32_t>(event.detail));
    case Problem::EmergencySent:
      break;
  }
  return fmt::format("sent an emergency: error {:04x}h", event.detail);
}

}  // namespace

std::string describe(const Event& event, std::string_view name) {
  return fmt::format("slave {} ({}): {}", event.slave, name, words(event));
}

}  // namespace indurop::io::ethercat
