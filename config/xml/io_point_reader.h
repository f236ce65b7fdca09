// SPDX-License-Identifier: Apache-2.0
// One <input> or <output> of ioconfig.xml.

#pragma once

#include <optional>

#include "base/diagnostics.h"
#include "base/xml_element.h"
#include "config/model/io_config.h"
#include "config/xml/attributes.h"

namespace indurop::config {

// Reads the point, whatever is wrong with it is reported.
IoPoint read_io_point(const base::Element& element, const IoDevice& device, base::Diagnostics& report);

// Attribute "unit" of a Modbus device or point.
std::optional<int> read_unit(Attributes& attributes, IoDriver driver);

// What the points of a device say together: two that are the same, or half of another.
void check_io_points(const IoDevice& device, base::Diagnostics& report);

}  // namespace indurop::config
