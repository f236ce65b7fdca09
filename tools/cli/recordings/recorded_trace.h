// SPDX-License-Identifier: Apache-2.0
// Runs of a recording as a trace that https://ui.perfetto.dev and chrome://tracing open (JSON trace event format).

#pragma once

#include <indurop/result.h>

#include <filesystem>

#include "core/base/problem.h"
#include "tools/cli/recordings/exported.h"

namespace indurop::tools {

// One process for each node, one track for each module; times relative to the first run. Errors: not a recording of
// runs.
Result<Exported, base::Problem> recorded_trace(const std::filesystem::path& file);

}  // namespace indurop::tools
