// SPDX-License-Identifier: Apache-2.0
// What lies in the instances of each program and function block, and that it is not more than later passes bear.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// When all variables are declared: fills what a Pou knows of its instances. False, with errors, if instances lie too
// deep inside each other or have too many variables; then nothing may go through the instances.
bool measure_instances(Context& context);

}  // namespace indurop::plc
