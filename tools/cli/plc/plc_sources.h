// SPDX-License-Identifier: Apache-2.0
// The arguments that select a PLC program and how it is read: the same for all verbs that compile it.

#pragma once

#include "control/plc/front/compiler.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds --dialect only. `dialect` must live as long as the options.
void add_plc_dialect(base::Options& app, std::optional<plc::Dialect>& dialect);

// `request` must live as long as the options.
void add_plc_sources(base::Options& app, plc::CompileOptions& request);

}  // namespace indurop::tools
