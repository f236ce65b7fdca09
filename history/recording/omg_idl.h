// SPDX-License-Identifier: Apache-2.0
// The type of a shared variable as OMG IDL, for readers of recordings that do not know our types (in MCAP: schema
// encoding "omgidl", message encoding "cdr").

#pragma once

#include <string>

#include "core/schema/schema.h"

namespace indurop::recording {

struct OmgIdl {
  std::string name;  // the struct of a message: "knu::Robot::joints_t", "indurop::value_double_10"
  std::string text;  // its definition, after all definitions it needs
};

// A message is a struct: any other type (numbers, text, arrays, enums) is wrapped in a struct of module indurop with
// the single member `value`. Equal types give equal texts.
OmgIdl omg_idl(const schema::Type& type);

}  // namespace indurop::recording
