// SPDX-License-Identifier: Apache-2.0
// Finds what is wrong with a node at this moment; past problems do not count.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "history/alarms/alarm_watch.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {

// Returns all modules of a running node; nothing if it does not run, or is only starting.
std::optional<std::vector<alarms::ModuleNow>> modules_now(const RunView& run);
std::optional<std::vector<alarms::ModuleNow>> modules_now(const std::string& node);

// Describes the modules that do not work, and other boards that are missing.
std::vector<std::string> trouble_now(const RunView& run, const std::optional<MirrorView>& mirror);

}  // namespace indurop::tools
