// SPDX-License-Identifier: Apache-2.0
// The data of a call is on the stack of the thread that runs the module, which has 512 KiB.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Reports POUs whose call needs too much of the stack, alone or with the POUs they call. Requires a program without
// errors.
void check_stack(Context& context);

}  // namespace indurop::plc
