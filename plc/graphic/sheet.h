// SPDX-License-Identifier: Apache-2.0
// A ladder or function block diagram read to the end: networks, order of execution, and what is wrong with it.

#pragma once

#include <string>
#include <vector>

#include "plc/graphic/networks.h"
#include "plc/graphic/order.h"
#include "plc/graphic/picture.h"
#include "plc/model/diagnostics.h"

namespace indurop::plc::graphic {

struct Sheet {
  std::vector<Network> networks;
  Index index;
  Order order;
};

// Refers to `body`, which must stay where it is. `what`: "POU main".
[[nodiscard]] Sheet make_sheet(Body& body, const std::string& what, Diagnostics& diagnostics);

// The pictures of its networks, ladders all as wide as the widest.
[[nodiscard]] std::vector<Picture> lay_out(const Sheet& sheet, Body::Language language);

// "rung" of a ladder, else "network".
[[nodiscard]] const char* word_of(Body::Language language) noexcept;

}  // namespace indurop::plc::graphic
