// SPDX-License-Identifier: Apache-2.0
// The alarms that the variables of a node declare: one for each element of an array and each field with a declaration.

#pragma once

#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace indurop::alarms {

struct DeclaredAlarm {
  std::string name;  // unique: "press::oil[2] > 80"
  std::string part;  // "press::oil[2]"
  std::string unit;
  schema::Alarm alarm;
  schema::Type type;  // of the part, one value
  std::uint32_t offset = 0;
  const schema::Variable* variable = nullptr;  // points into the store
  const vars::DirectoryEntry* entry = nullptr;
};

// Returns at most kMaxAlarms, in the order of the variables.
inline constexpr std::size_t kMaxAlarms = 4096;
std::vector<DeclaredAlarm> declared_alarms(const vars::Store& store);

}  // namespace indurop::alarms
