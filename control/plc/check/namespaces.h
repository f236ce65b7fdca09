// SPDX-License-Identifier: Apache-2.0
// NAMESPACE and USING: after this pass, all names of a project are unique again.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"

namespace indurop::plc {

// Gives each declaration in a namespace a unique name and replaces it in all references. Does nothing in projects
// without namespaces.
void resolve_namespaces(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
