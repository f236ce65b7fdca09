// SPDX-License-Identifier: Apache-2.0
// The contents of the instances of each program and function block, limited to what later passes can handle.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Call it after all variables are declared: fills the fields of Pou that describe its instances. Returns false, with
// errors, if instances are nested too deep or have too many variables; then no pass may walk through the instances.
bool measure_instances(Context& context);

}  // namespace indurop::plc
