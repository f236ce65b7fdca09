// SPDX-License-Identifier: Apache-2.0
// Names and numbers a manifest may contain, and what its parts need from one another.

#pragma once

#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "config/model/plant.h"

namespace indurop::config {

inline constexpr int kHighestDomain = 230;

// Of plants, boards and nodes: [A-Za-z0-9_-]{1,40}.
bool is_node_name(std::string_view name) noexcept;
// Empty, or what is wrong with the IP address or host name and what to write.
std::string address_problem(const std::string& address);
// Likewise for the name of a network interface.
std::string interface_problem(std::string_view name);

struct PlantPlaces {
  base::SourcePlace domain;    // line 0: not given
  base::SourcePlace external;  // likewise
};
// What can be wrong between elements that are right each on its own.
// Gives each module with <standby> a second one on that board.
void add_standbys(Plant& plant, base::Diagnostics& report);
void check_plant_rules(const Plant& plant, const PlantPlaces& places, base::Diagnostics& report);

}  // namespace indurop::config
