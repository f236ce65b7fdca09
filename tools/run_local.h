// SPDX-License-Identifier: Apache-2.0
// indurop run PLANT --local: every board of a plant as a node of this host, begun and ended together.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/verb.h"

namespace indurop::tools {

// `program`: indurop-node; `options` go to each node, --report with the board's name in the file's. Returns the exit
// code: that of the first board that failed, 130 after Ctrl-C.
int run_local(Context& context, const std::filesystem::path& program, const std::filesystem::path& plant,
              const std::vector<std::string>& options);

}  // namespace indurop::tools
