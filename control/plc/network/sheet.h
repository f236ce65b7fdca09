// SPDX-License-Identifier: Apache-2.0
// A ladder or function block diagram after all steps of reading: networks, execution order, and errors.

#pragma once

#include <string>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/network/networks.h"
#include "control/plc/network/order.h"

namespace indurop::plc::network {

struct Sheet {
  std::vector<Network> networks;
  Index index;
  Order order;
};

// The result refers to `body`, which must not move. `what`: "POU main".
[[nodiscard]] Sheet make_sheet(Body& body, const std::string& what, Diagnostics& diagnostics);

// Returns "rung" for a ladder, else "network".
[[nodiscard]] const char* word_of(Body::Language language) noexcept;

}  // namespace indurop::plc::network
