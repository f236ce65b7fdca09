// SPDX-License-Identifier: Apache-2.0
// <body> of a PLCopen file: text of ST and IL, elements of drawn languages. Errors in the drawing are not checked here.

#pragma once

#include "control/plc/network/diagram.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// `what` is for messages: "POU main", "POU main, action Blink".
[[nodiscard]] network::Body read_body(const Node& body, const std::string& what, Diagnostics& diagnostics);

// Returns the place with `what` added, so that messages name the body.
[[nodiscard]] Place within(Place at, const std::string& what);

// Returns all text below a node, a line per paragraph; stores the place where it begins in `at` unless that is null.
[[nodiscard]] std::string formatted_text(const Node& node, Place* at = nullptr);

}  // namespace indurop::plc::plcopen
