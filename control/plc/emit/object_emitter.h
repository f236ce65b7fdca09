// SPDX-License-Identifier: Apache-2.0
// Emits function blocks with methods, classes and interfaces: structs that extend each other, with virtual functions.

#pragma once

#include <string>

#include "control/plc/check/program.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// Returns "method_START", "getter_SPEED": the same for all that override each other, whatever their spelling.
[[nodiscard]] std::string method_name(const Pou& method);
// Returns the name of a variable of VAR_INST in the struct of the instance.
[[nodiscard]] std::string kept_name(const Variable& variable);
// Returns "std::int16_t a, plc::Motor& b" for a function or method.
[[nodiscard]] std::string parameters(const Pou& pou);
// Returns " : iec::Instance, virtual plc::Drive", or "".
[[nodiscard]] std::string extends(const Pou& pou);
// Emits a whole interface.
void emit_interface(const Pou& pou, TextWriter& out);
// Emits the methods inside of the struct, and the variables they keep.
void declare_methods(const Pou& pou, TextWriter& out);

}  // namespace indurop::plc
