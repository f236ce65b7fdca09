// SPDX-License-Identifier: Apache-2.0
// Object orientation in the extensions that CODESYS and TwinCAT add to the format: inheritance, methods, properties,
// interfaces.

#pragma once

#include <string>

#include "plc/plcopen/document.h"
#include "plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// What the extensions of a <pou> or <Interface> say of it.
void read_object(const Node& node, const std::string& what, PouDocument& into, Diagnostics& diagnostics);
// <Interface>, a POU of its own.
[[nodiscard]] PouDocument read_interface_object(const Node& node, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
