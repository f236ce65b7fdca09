// SPDX-License-Identifier: Apache-2.0
// What the types of .glb files are in a PLC program.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// int16_t is INT, uint8_t USINT, char[16] STRING[15], an enum and a struct types of the same name. Never null.
[[nodiscard]] const Type* foreign_type(Context& context, const schema::Type& type);

// Fills `foreign_names`.
void index_foreign(Program& program);
// The enumeration or struct of a .glb that "press.Mode", or "Mode" if only one is called so, means; null: there is
// none.
[[nodiscard]] const Type* foreign_type_named(Context& context, std::string_view path);
// The value "press.PRESSING", or "PRESSING" if only one enumeration of the .glb files has it: its enumeration, and
// `value`; null: there is none.
[[nodiscard]] const Type* foreign_enum_value(Context& context, std::string_view path, std::int64_t& value);

}  // namespace indurop::plc
