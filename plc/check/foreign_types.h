// SPDX-License-Identifier: Apache-2.0
// What the types of .glb files are in a PLC program.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// int16_t is INT, uint8_t USINT, char[16] STRING[15], an enum and a struct types of the same name. Never null.
[[nodiscard]] const Type* foreign_type(Context& context, const schema::Type& type);
// The struct or enumeration of this name that a shared variable is made of; null if there is none, or several.
[[nodiscard]] const Type* foreign_type_named(Context& context, std::string_view name);

}  // namespace indurop::plc
