// SPDX-License-Identifier: Apache-2.0
// Rules for names and numbers in a manifest, and between its elements.

#pragma once

#include <string>
#include <string_view>

#include "config/model/plant.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

inline constexpr int kHighestDomain = 230;

// Checks the name of a plant, board or node: [A-Za-z0-9_-]{1,40}.
bool is_node_name(std::string_view name) noexcept;
// Returns the error in an IP address or host name and how to correct it; empty if it is valid.
std::string address_problem(const std::string& address);
// Returns the error in the name of a network interface and how to correct it; empty if it is valid.
std::string interface_problem(std::string_view name);
// Returns the error in the name of an architecture and how to correct it; empty if it is valid.
std::string arch_problem(const std::string& name);

struct PlantPlaces {
  base::SourcePlace domain;    // line 0: not given
  base::SourcePlace external;  // line 0: not given
};
// Checks between elements that are each correct on their own. add_standbys() adds the second module of each module with
// <standby> to its standby board.
void add_standbys(Plant& plant, base::Diagnostics& report);
// Puts the architecture of the board in place of ${arch} in the file names of its modules and libraries of types.
void put_architectures(Plant& plant, base::Diagnostics& report);
void check_plant_rules(const Plant& plant, const PlantPlaces& places, base::Diagnostics& report);

}  // namespace indurop::config
