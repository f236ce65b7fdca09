// SPDX-License-Identifier: Apache-2.0
// Diagnostics of files as output of a program.

#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/console/context.h"

namespace indurop::tools {

// `as_data`: the diagnostics are the result of the verb (stdout), else they are messages (stderr).
void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics, bool as_data);
// Prints one line: OK and `content`, or FAILED and the number of errors.
void print_verdict(Context& context, const std::vector<base::Diagnostic>& diagnostics, const std::string& content);
// "1 module", "2 modules"
std::string counted(std::size_t n, const char* noun);
JsonValue diagnostics_json(const std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::tools
