// SPDX-License-Identifier: Apache-2.0
// In which order the elements of networks are evaluated, and which connections bring a value of the last scan.

#pragma once

#include <unordered_set>
#include <vector>

#include "plc/network/networks.h"

namespace indurop::plc::network {

struct Order {
  std::vector<const Element*> elements;            // sources before what they feed
  std::unordered_set<const Connection*> feedback;  // read before they are written
  std::vector<const Element*> circles;             // no element of these circles keeps its value: an error
};

// Network after network; inside from top to bottom, or as the numbers for the order of execution say where a diagram
// has some. Feedback is cut where it leaves an instance of a function block or a variable, if there is one, so that the
// topmost element of a circle comes first.
[[nodiscard]] Order order_of(const std::vector<Network>& networks, const Index& index);

// True if the value can be read before the element is evaluated: an instance or a variable keeps it.
[[nodiscard]] bool keeps_its_value(const Element& element) noexcept;

}  // namespace indurop::plc::network
