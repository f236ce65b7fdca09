// SPDX-License-Identifier: Apache-2.0
// Finds the contacts and coils of a drawing after which a running view can derive the power from the power before them
// and from whether they are closed. The module does not report power that can be derived.

#pragma once

#include <unordered_set>

#include "control/plc/network/sheet.h"

namespace indurop::plc::lower {

// Returns all elements after which the power equals that of any source, and contacts that are closed at the end of
// their network exactly if they were when they were evaluated: nothing in the network writes their variable.
[[nodiscard]] std::unordered_set<const network::Element*> derived_power(const network::Sheet& sheet);

}  // namespace indurop::plc::lower
