// SPDX-License-Identifier: Apache-2.0
// <after>: are the modules it names there, and before this one in the order of execution.

#pragma once

#include "base/diagnostics.h"
#include "config/model/config.h"

namespace indurop::config {

// Modules have their names. Takes names away that are no use, so that later checks can rely on the rest.
void check_after(Config& config, base::Diagnostics& report);

}  // namespace indurop::config
