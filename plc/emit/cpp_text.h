// SPDX-License-Identifier: Apache-2.0
// Names, types and values of a PLC program in C++.

#pragma once

#include <string>
#include <string_view>

#include "plc/check/program.h"
#include "plc/check/value_tree.h"

namespace indurop::plc {

// The name itself; with '_' behind it where C++ or the generated code has another use for it.
[[nodiscard]] std::string cpp_name(std::string_view name);
// "std::int16_t", "iec::String<80>", "std::array<plc::Motor, 3>"
[[nodiscard]] std::string cpp_type(const Type& type);
// The member of the image of the shared variables, or the constant.
[[nodiscard]] std::string cpp_name(const Global& global);
// "::main::I0"
[[nodiscard]] std::string proxy_of(const Global& global);

// A constant of exactly the C++ type, "std::int16_t{5}"; or where the context converts it anyway, "5".
[[nodiscard]] std::string cpp_constant(const Constant& value, const Type& type, bool exact);
// What a variable of the type begins with; "{}" for zero.
[[nodiscard]] std::string cpp_initial(const Type& type, const ast::Initial* initial);
// "text with escapes" as a literal.
[[nodiscard]] std::string quoted(std::string_view text);
// The same for a WSTRING: u"text".
[[nodiscard]] std::string wide_quoted(std::string_view utf8);
// What may stand behind "//": one line that does not go on in the next one.
[[nodiscard]] std::string comment_text(std::string_view text);
// {"prog.st:12:5", "MAIN"}
[[nodiscard]] std::string cpp_place(const Place& place, std::string_view pou);
// In parentheses if it is more than one operand.
[[nodiscard]] std::string wrapped(const std::string& expression);

}  // namespace indurop::plc
