// SPDX-License-Identifier: Apache-2.0
// Emits a POU: a struct with a call operator for programs and function blocks, a function for functions, a member
// function for methods. All are declared before the first body.

#pragma once

#include "control/plc/check/program.h"
#include "control/plc/emit/probes.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

void declare_pou(const Pou& pou, TextWriter& out);
void define_pou(const Pou& pou, TextWriter& out, const Probes& probes);

}  // namespace indurop::plc
