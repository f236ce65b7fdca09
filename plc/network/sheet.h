// SPDX-License-Identifier: Apache-2.0
// A ladder or function block diagram read to the end: networks, order of execution, and what is wrong with it.

#pragma once

#include <string>
#include <vector>

#include "plc/model/diagnostics.h"
#include "plc/network/networks.h"
#include "plc/network/order.h"

namespace indurop::plc::network {

struct Sheet {
  std::vector<Network> networks;
  Index index;
  Order order;
};

// Refers to `body`, which must stay where it is. `what`: "POU main".
[[nodiscard]] Sheet make_sheet(Body& body, const std::string& what, Diagnostics& diagnostics);

// "rung" of a ladder, else "network".
[[nodiscard]] const char* word_of(Body::Language language) noexcept;

}  // namespace indurop::plc::network
