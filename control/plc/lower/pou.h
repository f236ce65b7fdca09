// SPDX-License-Identifier: Apache-2.0
// Translates the code of one POU to statements, in any language.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/model/read_options.h"
#include "control/plc/network/diagram.h"

namespace indurop::plc::lower {

// Adds statements and hidden variables to `pou`, which is one of `project`.
void lower_pou(network::PouCode& pou_code, const ReadOptions& options, Project& project, ast::Pou& pou,
               Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
