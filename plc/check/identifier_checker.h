// SPDX-License-Identifier: Apache-2.0
// Everything that gets a name: what a parser lets through is one, but an attribute of an XML file may hold anything,
// and names go into C++, .glb and the names of files.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Errors for names that are none. Where there are, nothing may be emitted.
void check_identifiers(Context& context);

}  // namespace indurop::plc
