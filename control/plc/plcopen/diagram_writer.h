// SPDX-License-Identifier: Apache-2.0
// Writes the code of a POU, an action or a transition to a PLCopen file: texts unchanged, drawings with their places.

#pragma once

#include "control/plc/network/diagram.h"
#include "control/plc/plcopen/xml_writer.h"

namespace indurop::plc::plcopen {

// Writes below an open element: <ST>, <LD>...
void write_body(const network::Body& body, XmlWriter& out);

}  // namespace indurop::plc::plcopen
