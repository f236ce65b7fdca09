// SPDX-License-Identifier: Apache-2.0
// Chooses what a slave exchanges: the PDOs that have the objects an application wants, or PDOs that the master fills
// with them. plan_of() then has the writes that bring the slave there. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <span>
#include <string>

#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

struct WantedObject {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  // For a slave none of whose PDOs has the object; 0 bits: not known.
  std::uint8_t bits = 0;
  std::uint8_t type = 0;  // as CoE numbers its data types
};

struct Unmapped {
  WantedObject object;  // its index can be that of a PDO
  bool output = false;
  std::string reason;  // "no PDO of the slave has it, and what they contain is fixed"
};

// What the slave lets its master write in PREOP.
constexpr bool may_assign(const Sii& sii) noexcept {
  return (sii.protocols & kProtocolCoe) != 0 && (sii.coe_details & kCoePdoAssign) != 0;
}
constexpr bool may_fill(const Sii& sii, const Pdo& pdo) noexcept {
  return may_assign(sii) && (sii.coe_details & kCoePdoConfiguration) != 0 && (pdo.flags & kPdoFixed) == 0;
}

// Returns the EEPROM with the PDOs that have all of these objects assigned, and the others not: those that are assigned
// at first, if they have them; else the mandatory ones and as few others as are needed, never two with the same object;
// else those that may be filled, with the objects in their order. `pdos`, which the slave has, are assigned in any
// case, with what they contain at first. Errors: the first object, or PDO, that cannot be had.
Result<Sii, Unmapped> map_objects(Sii sii, std::span<const WantedObject> outputs, std::span<const WantedObject> inputs,
                                  std::span<const std::uint16_t> pdos = {});

}  // namespace indurop::io::ethercat
