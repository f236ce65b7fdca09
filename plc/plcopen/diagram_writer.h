// SPDX-License-Identifier: Apache-2.0
// Code of a POU, an action or a transition as a PLCopen file has it: texts as they are, drawings with their places.

#pragma once

#include "plc/network/diagram.h"
#include "plc/plcopen/xml_writer.h"

namespace indurop::plc::plcopen {

// Below an element that is open: <ST>, <LD>...
void write_body(const network::Body& body, XmlWriter& out);

}  // namespace indurop::plc::plcopen
