// SPDX-License-Identifier: Apache-2.0
// What belongs to a call lies on the stack of the thread that runs the module, which has 512 KiB.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Complains of POUs whose call needs too much of it, alone or with what they call. For a program without errors.
void check_stack(Context& context);

}  // namespace indurop::plc
