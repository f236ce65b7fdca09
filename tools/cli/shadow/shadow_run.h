// SPDX-License-Identifier: Apache-2.0
// Runs a new version of a module next to the one that runs, in a process of its own: what the running version begins
// each run with is taken from the node's tape, so the node does not notice.

#pragma once

#include <cstdint>
#include <string>

#include "tools/cli/shadow/shadow_report.h"
#include "tools/client/failure.h"

namespace indurop::tools {

struct ShadowRequest {
  std::string node;
  std::string module;
  std::string file;              // empty: that of the configuration
  std::int64_t duration_ns = 0;  // of the inputs that are taken
};

// Takes the inputs for that time, repeats the runs and compares. The processes for that are as gentle as can be, have
// at most a minute of processor time each, and end with this one. Errors: the node does not run or has no such module;
// it cannot be repeated, or ends the process; the text says why.
Result<ShadowReport, Failure> run_shadow(Context& context, const ShadowRequest& request);

}  // namespace indurop::tools
