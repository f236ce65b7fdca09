// SPDX-License-Identifier: Apache-2.0
// First phase of a run: reads and checks the configuration and reports its errors.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "config/check/check.h"
#include "network/mirror/frames/settings.h"
#include "node/parts/board_routes.h"
#include "node/parts/external_part.h"
#include "node/parts/plant_part.h"
#include "node/run/ending.h"
#include "node/run/options.h"

namespace indurop::node {

struct Checked {
  config::Config config;
  config::CheckResult check;
  std::optional<mirror::Settings> mirror;  // of a board of a plant
  BoardRoutes routes;                      // what `mirror` exchanges
  ExternalPart external;
  std::vector<std::uint32_t> replaced;  // indices of modules with a file of --with
  std::optional<std::uint32_t> alone;   // index of the only module that is loaded, for Replay::report
};

// A configuration that was read and checked as the node does it at its start.
struct Rechecked {
  bool ok = false;
  config::Config config;  // meaningful only if ok, as `check`
  config::CheckResult check;
  std::vector<base::Diagnostic> diagnostics;
  std::optional<mirror::Settings> mirror;  // of a board of a plant
};
// Of a module.xml, or the manifest of the plant if this is the node of a board.
Rechecked recheck(const Options& options, const std::filesystem::path& file);
// Of one that was checked before.
Rechecked recheck(const Options& options, const config::Config& config);

Result<Checked, Ending> check(const Options& options, const Console& console);

}  // namespace indurop::node
