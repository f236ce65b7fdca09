// SPDX-License-Identifier: Apache-2.0
// Translates the code of all POUs of a project to statements.

#pragma once

#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/model/read_options.h"
#include "control/plc/st/chart_parser.h"

namespace indurop::plc::lower {

// `bodies`: of POUs and methods of `project`; afterwards their places name the rungs. All POUs are known before the
// first body is translated, whatever file they are in.
void lower_bodies(std::vector<st::WrittenBody>& bodies, Project& project, const ReadOptions& options,
                  Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
