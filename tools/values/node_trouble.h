// SPDX-License-Identifier: Apache-2.0
// What is wrong with a node at this moment: what was wrong before and is over does not count.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "alarms/alarm_watch.h"
#include "tools/values/mirror_view.h"
#include "tools/values/run_view.h"

namespace indurop::tools {

// All modules of a node that runs; nothing if it does not, or is only starting.
std::optional<std::vector<alarms::ModuleNow>> modules_now(const RunView& run);
std::optional<std::vector<alarms::ModuleNow>> modules_now(const std::string& node);

// Modules that do not do their work, and other boards that are not there, in words.
std::vector<std::string> trouble_now(const RunView& run, const std::optional<MirrorView>& mirror);

}  // namespace indurop::tools
