// SPDX-License-Identifier: Apache-2.0
// Lets a verb continue as indurop-serve.

#pragma once

#include "tools/cli/command/verb.h"
#include "tools/console/serve_options.h"

namespace indurop::tools {

// Returns only after an error, which has been printed, with its exit code.
int become_server(Context& context, const ServeOptions& options);

}  // namespace indurop::tools
