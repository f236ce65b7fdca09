// SPDX-License-Identifier: Apache-2.0
// Function blocks with methods, classes and interfaces in C++: structs that extend each other, with virtual functions.

#pragma once

#include <string>

#include "plc/check/program.h"
#include "plc/emit/text_writer.h"

namespace indurop::plc {

// "method_START", "getter_SPEED": the same for all that replace each other, however they are spelled.
[[nodiscard]] std::string method_name(const Pou& method);
// Of a variable of VAR_INST in the struct of the instance.
[[nodiscard]] std::string kept_name(const Variable& variable);
// "std::int16_t a, plc::Motor& b" of a function or method.
[[nodiscard]] std::string parameters(const Pou& pou);
// " : iec::Instance, virtual plc::Drive", or "".
[[nodiscard]] std::string extends(const Pou& pou);
// An interface, whole.
void emit_interface(const Pou& pou, TextWriter& out);
// Inside of the struct: its methods, and what they keep.
void declare_methods(const Pou& pou, TextWriter& out);

}  // namespace indurop::plc
