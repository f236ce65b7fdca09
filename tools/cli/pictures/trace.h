// SPDX-License-Identifier: Apache-2.0
// The slot log as a trace that https://ui.perfetto.dev and chrome://tracing open (JSON trace event format).

#pragma once

#include <span>
#include <string>

#include "tools/client/node/run_view.h"

namespace indurop::tools {

// One track per module; times relative to tick 0.
std::string trace_json(const RunView& run, const std::string& node, std::span<const SlotSample> samples);

}  // namespace indurop::tools
