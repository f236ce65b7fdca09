// SPDX-License-Identifier: Apache-2.0
// The type of a shared variable as OMG IDL, for readers of recordings who know nothing of our types (in MCAP: schema
// encoding "omgidl", message encoding "cdr").

#pragma once

#include <string>

#include "schema/schema.h"

namespace indurop::recording {

struct OmgIdl {
  std::string name;  // the struct that a message is: "knu::Robot::joints_t", "indurop::value_double_10"
  std::string text;  // its definition, after all that it needs
};

// A message is a struct: what is none (numbers, text, arrays, enums) becomes a struct of module indurop, with one
// member `value`. Equal types give equal texts.
OmgIdl omg_idl(const schema::Type& type);

}  // namespace indurop::recording
