// SPDX-License-Identifier: Apache-2.0
// What irp_describe() and irp_recording_describe() fill.

#pragma once

#include <indurop/c.h>

#include <string>

#include "core/schema/schema.h"

namespace indurop::c {

// The texts of a variable or a part of one that a C program keeps pointers to.
struct Texts {
  std::string name;
  std::string type;
  std::string layout;
};
Texts texts_of(std::string name, const schema::Type& type);

// Returns false if `variable` is null or has no size. The result points into `texts` and `place`.
bool describe(const Texts& texts, const schema::Place& place, irp_variable* variable);

}  // namespace indurop::c
