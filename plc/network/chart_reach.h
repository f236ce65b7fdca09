// SPDX-License-Identifier: Apache-2.0
// Which steps of a chart can become active, and whether one can become active while it is: then its sequence runs twice
// at once, because a branch of simultaneous sequences was left by another way than their common end.

#pragma once

#include "plc/model/diagnostics.h"
#include "plc/network/chart.h"

namespace indurop::plc::network {

// Warnings at the steps. Requires a chart without errors.
void warn_about_reach(const Chart& chart, Diagnostics& diagnostics);

}  // namespace indurop::plc::network
