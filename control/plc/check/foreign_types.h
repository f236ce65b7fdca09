// SPDX-License-Identifier: Apache-2.0
// Types of .glb files as types of a PLC program.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Returns the type of the PLC program: int16_t is INT, uint8_t USINT, char[16] STRING[15]; an enum or struct is a type
// of the same name. Never null.
[[nodiscard]] const Type* foreign_type(Context& context, const schema::Type& type);

// Fills `foreign_names`.
void index_foreign(Program& program);
// Returns the enumeration or struct of a .glb named "press.Mode", or "Mode" if only one has that name; null if there is
// none.
[[nodiscard]] const Type* foreign_type_named(Context& context, std::string_view path);
// Returns the enumeration that has the value "press.PRESSING", or "PRESSING" if only one enumeration of the .glb files
// has it, and sets `value`; null if there is none.
[[nodiscard]] const Type* foreign_enum_value(Context& context, std::string_view path, std::int64_t& value);

}  // namespace indurop::plc
