// SPDX-License-Identifier: Apache-2.0
// Derives the settings of one board's mirror from a checked plant. Pure translation.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/check/check_plant.h"
#include "network/mirror/frames/settings.h"

namespace indurop::node {

// The keys of a board; off in a plant without keys.
dds::Security board_security(const config::Plant& plant, const std::string& board);
// How board number `board` finds the others of its plant, on any plane: domain, keys and lease are the plane's.
dds::NetworkSettings network_settings(const config::Plant& plant, std::size_t board);

// `board`: index into plant.boards. The caller sets priority and cores.
mirror::Settings mirror_settings(const config::Plant& plant, const config::PlantCheck& check, std::size_t board);

}  // namespace indurop::node
