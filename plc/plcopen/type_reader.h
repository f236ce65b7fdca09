// SPDX-License-Identifier: Apache-2.0
// Data types and initial values of a PLCopen file. The format says them in elements; what it leaves as Structured Text
// are single expressions: bounds, lengths, values of enumerations, and each <simpleValue>.

#pragma once

#include <optional>
#include <string>

#include "plc/model/ast.h"
#include "plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// What is below <type>, <baseType>, <returnType>; none after errors. `what` is for messages: "POU main, variable a".
[[nodiscard]] std::optional<ast::TypeSpec> read_type(const Node& holder, const std::string& what,
                                                     Diagnostics& diagnostics);
// What <initialValue> below `holder` says; none where there is none, and after errors.
[[nodiscard]] std::optional<ast::Initial> read_initial(const Node& holder, const std::string& what,
                                                       Diagnostics& diagnostics);
// <documentation> as one line; "" for none.
[[nodiscard]] std::string comment_of(const Node& node);

}  // namespace indurop::plc::plcopen
