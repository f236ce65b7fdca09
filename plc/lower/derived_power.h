// SPDX-License-Identifier: Apache-2.0
// Behind which contacts and coils of a drawing a running view can tell the power by itself: that before them, and
// whether they are closed. What it can tell, the module does not.

#pragma once

#include <unordered_set>

#include "plc/network/sheet.h"

namespace indurop::plc::lower {

// All behind which power is that of any source, and of a contact that it is closed at the end of its network as when it
// was looked at: nothing in the network writes what it names.
[[nodiscard]] std::unordered_set<const network::Element*> derived_power(const network::Sheet& sheet);

}  // namespace indurop::plc::lower
