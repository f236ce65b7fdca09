// SPDX-License-Identifier: Apache-2.0
// Warnings about declared but unused items of a POU: variables, outputs, instances, its body.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Requires a checked body.
void warn_about_usage(Context& context, const Pou& pou);

}  // namespace indurop::plc
