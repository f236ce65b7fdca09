// SPDX-License-Identifier: Apache-2.0
// Reads the elements of <LD>, <FBD> and <SFC> as data.

#pragma once

#include "control/plc/network/diagram.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

[[nodiscard]] network::Diagram read_elements(const Node& language, const std::string& what, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
