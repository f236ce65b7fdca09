// SPDX-License-Identifier: Apache-2.0
// What modules kept after a tick of a recording: a node repeats the runs from the keyframes before it up to this tick.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"

namespace indurop::tools {

struct ReplayedTick {
  base::Json modules;                 // as the node writes them (docs/recording.md)
  std::uint64_t differing = 0;        // values of the tick's runs that differ from the recorded ones
  std::vector<std::string> messages;  // warnings and errors of the node
};

// Starts indurop-node as the node `node` and waits for it, at most 30 s. `board`: of a file that joins several
// recordings; else empty. `config`: empty: that of the recording. Executes the modules of the configuration. Errors: it
// cannot be replayed; the reason is the node's last error.
Result<ReplayedTick, base::Problem> replay_tick(const std::filesystem::path& file, const std::string& board,
                                                const std::filesystem::path& config, std::uint64_t tick,
                                                const std::string& node);

}  // namespace indurop::tools
