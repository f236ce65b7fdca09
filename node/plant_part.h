// SPDX-License-Identifier: Apache-2.0
// From a checked plant and its schedule to what one board's mirror needs. Pure translation.

#pragma once

#include <cstddef>

#include "deploy/plant.h"
#include "mirror/settings.h"
#include "scheduler/engine.h"

namespace indurop::node {

// `board`: index into plant.boards. Priority and cores are left to the caller.
mirror::Settings mirror_settings(const deploy::Plant& plant, const deploy::PlantCheck& check, std::size_t board);

// Says in `settings` which of the outgoing variables are written by one band only. `engine` is borrowed for as long as
// the settings are used.
void name_writers(mirror::Settings& settings, const deploy::Config& config, const deploy::CheckResult& check,
                  const scheduler::Engine& engine);

}  // namespace indurop::node
