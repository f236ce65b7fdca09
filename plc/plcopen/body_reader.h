// SPDX-License-Identifier: Apache-2.0
// <body> of a PLCopen file: text of ST and IL, elements of drawn languages. What is drawn wrongly is not looked at
// here.

#pragma once

#include "plc/network/diagram.h"
#include "plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// `what` is for messages: "POU main", "POU main, action Blink".
[[nodiscard]] network::Body read_body(const Node& body, const std::string& what, Diagnostics& diagnostics);

// The place, named: messages about it say what it is in.
[[nodiscard]] Place within(Place at, const std::string& what);

// All text below a node, a line per paragraph; where it begins goes to `at` if that is wanted.
[[nodiscard]] std::string formatted_text(const Node& node, Place* at = nullptr);

}  // namespace indurop::plc::plcopen
