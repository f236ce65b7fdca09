// SPDX-License-Identifier: Apache-2.0
// The part of a module built with --watch that tells the values of its programs.

#pragma once

#include <string>
#include <vector>

#include "plc/check/program.h"
#include "plc/emit/text_writer.h"

namespace indurop::plc {

// "show(out, instance)" for each of the POUs that has instances; in namespace plc.
void emit_watched(const std::vector<const Pou*>& pous, TextWriter& out);
// "watch()" for the instances of the task, named as in the module; `space`: of the shared variables.
void emit_watch(const TaskPlan& task, const std::string& space, TextWriter& out);

}  // namespace indurop::plc
