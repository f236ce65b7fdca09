// SPDX-License-Identifier: Apache-2.0
// Data types and values of a PLCopen file as Structured Text, so that one parser reads them wherever they come from.

#pragma once

#include <string>

#include "plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// What is below <type>, <baseType>, <returnType>: "ARRAY[0..9] OF INT". "" after errors.
[[nodiscard]] std::string type_text(const Node& type, Diagnostics& diagnostics);
// What is below <initialValue>: "5", "[1, 2(0)]", "(x := 1)". "" for nothing.
[[nodiscard]] std::string value_text(const Node& value);

}  // namespace indurop::plc::plcopen
