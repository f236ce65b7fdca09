// SPDX-License-Identifier: Apache-2.0
// From a checked plant to what one board's mirror needs. Pure translation.

#pragma once

#include <cstddef>

#include "deploy/plant.h"
#include "mirror/settings.h"

namespace indurop::node {

// `board`: index into plant.boards. Priority and cores are left to the caller.
mirror::Settings mirror_settings(const deploy::Plant& plant, const deploy::PlantCheck& check, std::size_t board);

}  // namespace indurop::node
