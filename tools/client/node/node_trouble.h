// SPDX-License-Identifier: Apache-2.0
// Finds what is wrong with a node at this moment; past problems do not count.

#pragma once

#include <cstdint>
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

// Returns a sentence if the clocks of both boards are said to be synchronized, but are measured to differ by more than
// a tenth of the basic period (in ns; 0: unknown), so that ticks of the boards no longer begin together.
std::optional<std::string> clocks_apart(const MirrorView& mirror, const PeerView& peer, std::int64_t basic_period_ns);

// Describes why retained variables are not saved at present; empty: they are, or the node does not run.
std::string unsaved_text(const RunView& run);

// Describes the modules that do not work, values that are not saved, other boards that are missing, and clocks that
// differ.
std::vector<std::string> trouble_now(const RunView& run, const std::optional<MirrorView>& mirror);

}  // namespace indurop::tools
