// SPDX-License-Identifier: Apache-2.0
// First phase of a run: reads and checks the configuration and reports its errors.

#pragma once

#include <optional>

#include "config/check/check.h"
#include "network/mirror/frames/settings.h"
#include "node/parts/external_part.h"
#include "node/run/ending.h"
#include "node/run/options.h"

namespace indurop::node {

struct Checked {
  config::Config config;
  config::CheckResult check;
  std::optional<mirror::Settings> mirror;  // of a board of a plant
  ExternalPart external;
};

Result<Checked, Ending> check(const Options& options, const Console& console);

}  // namespace indurop::node
