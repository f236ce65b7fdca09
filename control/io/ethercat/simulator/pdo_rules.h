// SPDX-License-Identifier: Apache-2.0
// The objects of a simulated slave that say what it exchanges: PDOs and their assignment to SyncManagers, and when a
// master may write them, as slaves with a processor judge it.

#pragma once

#include "control/io/ethercat/registers.h"
#include "control/io/ethercat/sii.h"
#include "control/io/ethercat/simulator/object_dictionary.h"

namespace indurop::io::ethercat {

inline constexpr std::uint8_t kPdoCapacity = 8;  // objects that a PDO can take, unless it has more at first

// Adds those of the EEPROM to the dictionary; none if the slave has no CoE.
void add_pdo_objects(const Sii& sii, ObjectDictionary& objects);

struct ObjectWrite {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::uint64_t number = 0;
};
// Returns why a write is refused in this state: PDOs and assignments are written in PREOP only, their entries while
// subindex 0 is 0. A PDO may be assigned meanwhile, as with slaves of Beckhoff's stack: what is exchanged is judged
// when the slave leaves PREOP. Nothing: it is not refused, or is none of these objects.
std::optional<std::uint32_t> judge_mapping(const Sii& sii, const ObjectDictionary& objects, AlState state,
                                           const ObjectWrite& write);

}  // namespace indurop::io::ethercat
