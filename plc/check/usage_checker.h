// SPDX-License-Identifier: Apache-2.0
// Warnings about what a POU declares and does not use: variables, outputs, instances, its body.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Requires that the body was checked.
void warn_about_usage(Context& context, const Pou& pou);

}  // namespace indurop::plc
