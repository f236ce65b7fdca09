// SPDX-License-Identifier: Apache-2.0
// indurop recording export: values of a recording as CSV, its runs as a trace for Perfetto.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_export(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
