// SPDX-License-Identifier: Apache-2.0
// Checks all names: those from a parser are valid, but an attribute of an XML file may contain anything, and names go
// into C++, .glb and the names of files.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Reports names that are not valid. If there are any, nothing may be emitted.
void check_identifiers(Context& context);

}  // namespace indurop::plc
