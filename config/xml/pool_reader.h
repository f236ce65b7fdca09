// SPDX-License-Identifier: Apache-2.0
// Reads <pool> of a manifest: a pool whose chunks are sent from one board to others.

#pragma once

#include <optional>

#include "config/model/plant.h"
#include "config/xml/element_rules.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Returns nothing after an error that leaves no pool or no boards. `pools`: the first place of each name.
std::optional<PoolRoute> read_pool_route(const base::Element& element, FirstPlaces& pools, base::Diagnostics& report);
// Checks that the boards exist, that none is named twice, and that no board sends to itself.
void check_pool_boards(const Plant& plant, base::Diagnostics& report);

}  // namespace indurop::config
