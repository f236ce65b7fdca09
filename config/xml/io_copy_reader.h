// SPDX-License-Identifier: Apache-2.0
// <copy> of EtherCAT devices in ioconfig.xml: what goes from one slave to another.

#pragma once

#include "config/model/io_config.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Reads a <copy>, adds it to the device, and reports all its errors.
void read_io_copy(const base::Element& element, IoDevice& device, base::Diagnostics& report);

// Checks copies once all devices are known, and adds to each device what others copy from it.
void link_io_copies(IoConfig& config, base::Diagnostics& report);

}  // namespace indurop::config
