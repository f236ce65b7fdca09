// SPDX-License-Identifier: Apache-2.0
// NAMESPACE and USING: behind this, all names of a project are its own again.

#pragma once

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"

namespace indurop::plc {

// Gives everything that stands in a namespace a name of its own, and this name to all that mean it. Nothing is done
// where there are no namespaces.
void resolve_namespaces(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
