// SPDX-License-Identifier: Apache-2.0
// Reads object orientation from the extensions that CODESYS and TwinCAT add to the format: inheritance, methods,
// properties, interfaces.

#pragma once

#include <string>

#include "control/plc/plcopen/document.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// Reads the extensions of a <pou> or <Interface>.
void read_object(const Node& node, const std::string& what, PouDocument& into, Diagnostics& diagnostics);
// Reads <Interface>, which is a POU.
[[nodiscard]] PouDocument read_interface_object(const Node& node, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
