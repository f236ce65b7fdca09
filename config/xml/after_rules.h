// SPDX-License-Identifier: Apache-2.0
// Checks of <after>: the modules it names must exist and come before this one in the order of execution.

#pragma once

#include "config/model/config.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

// Call it when modules have their names. Removes invalid names, so that later checks can rely on the others.
void check_after(Config& config, base::Diagnostics& report);

}  // namespace indurop::config
