// SPDX-License-Identifier: Apache-2.0
// Finds the order in which the elements of networks are evaluated, and the connections that bring a value of the last
// scan.

#pragma once

#include <unordered_set>
#include <vector>

#include "control/plc/network/networks.h"

namespace indurop::plc::network {

struct Order {
  std::vector<const Element*> elements;            // sources before the elements they feed
  std::unordered_set<const Connection*> feedback;  // read before they are written
  std::vector<const Element*> circles;             // circles in which no element keeps its value: an error
};

// Orders network by network; inside a network from top to bottom, or by the execution numbers if the diagram has some.
// Feedback is cut where it leaves an instance of a function block or a variable, if there is one, so that the topmost
// element of a circle comes first.
[[nodiscard]] Order order_of(const std::vector<Network>& networks, const Index& index);

// Returns true if the value can be read before the element is evaluated: an instance or a variable keeps it.
[[nodiscard]] bool keeps_its_value(const Element& element) noexcept;

}  // namespace indurop::plc::network
