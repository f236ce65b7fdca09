// SPDX-License-Identifier: Apache-2.0
// How a simulated axis finds its reference mark.

#pragma once

#include "config/model/io_config.h"
#include "config/xml/attributes.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

// Reads `homing`, and checks that the axis has the switches that the method needs.
void read_io_homing(Attributes& attributes, IoDevice& device, base::Diagnostics& report);

}  // namespace indurop::config
