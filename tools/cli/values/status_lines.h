// SPDX-License-Identifier: Apache-2.0
// A node as lines of text, for `status`.

#pragma once

#include <string>
#include <vector>

#include "tools/client/node/external_view.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/run_report.h"
#include "tools/console/output.h"

namespace indurop::tools {

// Returns two or three lines: state, key values, real-time privileges.
std::vector<std::string> header_lines(const NodeReport& report, const Output& output);
std::vector<std::string> mirror_lines(const MirrorView& view, const Output& output);
std::vector<std::string> external_lines(const ExternalView& view, const Output& output);

}  // namespace indurop::tools
