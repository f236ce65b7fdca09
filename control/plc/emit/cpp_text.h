// SPDX-License-Identifier: Apache-2.0
// Names, types and values of a PLC program in C++.

#pragma once

#include <string>
#include <string_view>

#include "control/plc/check/program.h"
#include "control/plc/check/value_tree.h"

namespace indurop::plc {

// Returns the name; with '_' appended if C++ or the generated code uses it otherwise.
[[nodiscard]] std::string cpp_name(std::string_view name);
// "std::int16_t", "iec::String<80>", "std::array<plc::Motor, 3>"
[[nodiscard]] std::string cpp_type(const Type& type);
// Returns the member of the image of the shared variables, or the constant.
[[nodiscard]] std::string cpp_name(const Global& global);
// "::main::I0"
[[nodiscard]] std::string proxy_of(const Global& global);

// Returns a constant of exactly the C++ type, "std::int16_t{5}"; or "5" if the context converts it anyway.
[[nodiscard]] std::string cpp_constant(const Constant& value, const Type& type, bool exact);
// Returns the initial value of a variable of the type; "{}" for zero.
[[nodiscard]] std::string cpp_initial(const Type& type, const ast::Initial* initial);
// "text with escapes" as a literal.
[[nodiscard]] std::string quote(std::string_view text);
// As quote(), for a WSTRING: u"text".
[[nodiscard]] std::string wide_quoted(std::string_view utf8);
// Returns the text as a valid one-line comment after "//", without a line continuation.
[[nodiscard]] std::string comment_text(std::string_view text);
// {"prog.st:12:5", "MAIN"}
[[nodiscard]] std::string cpp_place(const Place& place, std::string_view pou);
// Returns the expression, in parentheses if it is more than one operand.
[[nodiscard]] std::string wrapped(const std::string& expression);

}  // namespace indurop::plc
