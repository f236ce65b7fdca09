// SPDX-License-Identifier: Apache-2.0
// Variables at addresses: `AT %IX0.0`, and those without a place yet, `AT %I*`.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Returns the variable at an address; declares it if no declaration names the address.
Global& located_global(Context& context, const ast::DirectAddress& address, const Place& at);
// Declares a variable at an address: `name AT %IX0.0 : type`.
Global& declare_located(Context& context, ast::Variable& variable, const Type& type);
// Declares a variable without an address, `name AT %I* : type`; null after an error where that is not possible.
Global* declare_placeless(Context& context, ast::Variable& variable, const Type& type);

}  // namespace indurop::plc
