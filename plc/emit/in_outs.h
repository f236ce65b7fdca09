// SPDX-License-Identifier: Apache-2.0
// VAR_IN_OUT of function blocks that methods use: they may run when what the last call gave is gone.

#pragma once

#include <string>

#include "plc/check/program.h"
#include "plc/emit/text_writer.h"

namespace indurop::plc {

// Of an instance that took over the variables of another one: what was given to that one is not its own.
void forget_in_outs(const Type& block, const std::string& instance, TextWriter& out);

}  // namespace indurop::plc
