// SPDX-License-Identifier: Apache-2.0
// Object orientation of the third edition: what extends and implements what, and whether it may.

#pragma once

#include <string>

#include "plc/check/context.h"

namespace indurop::plc {

// Finds what EXTENDS and IMPLEMENTS name. Requires that all POUs are declared.
void declare_objects(Context& context);
// Methods: doubles, those that are replaced or missing. Requires the variables of all POUs.
void check_objects(Context& context);
// What to say to an instance of something ABSTRACT.
[[nodiscard]] std::string abstract_instance(const Pou& pou);

}  // namespace indurop::plc
