// SPDX-License-Identifier: Apache-2.0
// Reads one <input> or <output> of ioconfig.xml.

#pragma once

#include <optional>

#include "config/model/io_config.h"
#include "config/xml/attributes.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Reads the point and reports all its errors.
IoPoint read_io_point(const base::Element& element, const IoDevice& device, base::Diagnostics& report);

// Reads the attribute "unit" of a Modbus device or point.
std::optional<int> read_unit(Attributes& attributes, IoDriver driver);

// Checks the points of a device against each other: reports duplicates and overlapping points.
void check_io_points(const IoDevice& device, base::Diagnostics& report);

}  // namespace indurop::config
