// SPDX-License-Identifier: Apache-2.0
// The slaves of simulated EtherCAT buses in ioconfig.xml.

#pragma once

#include "config/model/io_config.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Reads a <simulation>, adds it to the configuration, and reports all its errors. What its words and its script say, a
// simulation itself reads.
void read_io_simulation(const base::Element& element, IoConfig& config, base::Diagnostics& report);
// Once all devices are there: reports simulations of buses that none of them is on.
void check_io_simulations(const IoConfig& config, base::Diagnostics& report);

}  // namespace indurop::config
