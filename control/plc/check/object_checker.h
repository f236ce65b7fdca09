// SPDX-License-Identifier: Apache-2.0
// Object orientation of the third edition: checks EXTENDS and IMPLEMENTS.

#pragma once

#include <string>

#include "control/plc/check/context.h"

namespace indurop::plc {

// Resolves the names after EXTENDS and IMPLEMENTS. Requires that all POUs are declared.
void declare_objects(Context& context);
// Checks methods: duplicates, overrides, and missing ones. Requires the variables of all POUs.
void check_objects(Context& context);
// Returns the message for an instance of an ABSTRACT type.
[[nodiscard]] std::string abstract_instance(const Pou& pou);

}  // namespace indurop::plc
