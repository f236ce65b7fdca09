// SPDX-License-Identifier: Apache-2.0
// <accessVars> and <configVars> of a PLCopen file: variables that are named from outside of POUs.

#pragma once

#include <string>
#include <vector>

#include "control/plc/model/project.h"
#include "control/plc/plcopen/declaration_writer.h"
#include "control/plc/plcopen/xml.h"

namespace indurop::plc::plcopen {

// Reads <accessVars>; of the PROGRAM of this name, unless it is empty.
void read_accesses(const Node& list, const std::string& program, const std::string& what, std::vector<Access>& into,
                   Diagnostics& diagnostics);
// Reads <configVars>.
void read_configured(const Node& list, const std::string& what, std::vector<Configured>& into,
                     Diagnostics& diagnostics);

// Writes both, in the order of <configuration>: after its global variables.
void write_outside(const Project& project, XmlWriter& out, DeclarationWriter& declarations, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
