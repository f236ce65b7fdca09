// SPDX-License-Identifier: Apache-2.0
// Finds the steps of a chart that can become active, and those that can become active while they are active: then their
// sequence runs twice at the same time, because a branch of simultaneous sequences was left other than by their common
// end.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/network/chart.h"

namespace indurop::plc::network {

// Reports warnings at the steps. Requires a chart without errors.
void warn_about_reach(const Chart& chart, Diagnostics& diagnostics);

}  // namespace indurop::plc::network
