// SPDX-License-Identifier: Apache-2.0
// A verb of `indurop`: a name, a help text, options, and an action. One file per verb (tools/cli/verbs); verbs.cpp has
// the list of all.

#pragma once

#include <functional>
#include <span>

#include "core/base/exit_code.h"
#include "core/base/options.h"
#include "tools/console/context.h"

namespace indurop::tools {

using Action = std::function<int(Context&)>;

struct Verb {
  const char* name = "";
  const char* group = "";    // heading in the list of verbs
  const char* summary = "";  // one line
  const char* details = "";  // below the options: what it prints, examples
  // Adds the verb's options to `app` and returns the action to run after they are parsed.
  Action (*declare)(base::Options& app, Context& context) = nullptr;
};

std::span<const Verb> all_verbs();

}  // namespace indurop::tools
