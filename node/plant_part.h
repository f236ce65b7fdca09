// SPDX-License-Identifier: Apache-2.0
// From a checked plant and its schedule to what one board's mirror needs. Pure translation.

#pragma once

#include <cstddef>

#include "config/check/check_plant.h"
#include "mirror/frames/settings.h"
#include "scheduler/engine.h"

namespace indurop::node {

// The keys of a board; off in a plant without.
dds::Security board_security(const config::Plant& plant, const std::string& board);
// How board number `board` finds the others of its plant, on whichever plane: domain, keys and lease are the plane's.
dds::NetworkSettings network_settings(const config::Plant& plant, std::size_t board);

// `board`: index into plant.boards. Priority and cores are left to the caller.
mirror::Settings mirror_settings(const config::Plant& plant, const config::PlantCheck& check, std::size_t board);

// Says in `settings` which of the outgoing variables are written by one band only. `engine` is borrowed for as long as
// the settings are used.
void name_writers(mirror::Settings& settings, const config::Config& config, const config::CheckResult& check,
                  const scheduler::Engine& engine);

}  // namespace indurop::node
