// SPDX-License-Identifier: Apache-2.0
// VAR_IN_OUT of function blocks used by methods: these may run after the variables passed to the last call are gone.

#pragma once

#include <string>

#include "control/plc/check/program.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// Emits code for an instance that was copied from another one: clears the VAR_IN_OUT passed to the other one.
void forget_in_outs(const Type& block, const std::string& instance, TextWriter& out);

}  // namespace indurop::plc
