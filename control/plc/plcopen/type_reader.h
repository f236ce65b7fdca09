// SPDX-License-Identifier: Apache-2.0
// Reads data types and initial values of a PLCopen file. The format expresses them in elements; only single expressions
// are Structured Text: bounds, lengths, values of enumerations, and each <simpleValue>.

#pragma once

#include <optional>
#include <string>

#include "control/plc/model/ast.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// Reads the type below <type>, <baseType>, <returnType>; none after errors. `what` is for messages: "POU main, variable
// a".
[[nodiscard]] std::optional<ast::TypeSpec> read_type(const Node& holder, const std::string& what,
                                                     Diagnostics& diagnostics);
// Reads <initialValue> below `holder`; none if it is missing, and after errors.
[[nodiscard]] std::optional<ast::Initial> read_initial(const Node& holder, const std::string& what,
                                                       Diagnostics& diagnostics);
// Returns <documentation> as one line; "" if it is missing.
[[nodiscard]] std::string comment_of(const Node& node);

}  // namespace indurop::plc::plcopen
