// SPDX-License-Identifier: Apache-2.0
// A verb that becomes indurop-serve.

#pragma once

#include "tools/command/serve_options.h"
#include "tools/command/verb.h"

namespace indurop::tools {

// Does not return, but for an error, which was said: its exit code.
int become_server(Context& context, const ServeOptions& options);

}  // namespace indurop::tools
