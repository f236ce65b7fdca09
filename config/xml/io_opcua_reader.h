// SPDX-License-Identifier: Apache-2.0
// Reads what a device of OPC UA and its points have of their own.

#pragma once

#include "config/model/io_config.h"
#include "config/xml/attributes.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

// The address of the server, and how it is reached.
void read_io_server(Attributes& attributes, IoDevice& device, base::Diagnostics& report);
// `at`, a NodeId.
void read_io_node(Attributes& attributes, IoPoint& point, base::Diagnostics& report);

}  // namespace indurop::config
