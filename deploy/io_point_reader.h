// SPDX-License-Identifier: Apache-2.0
// One <input> or <output> of ioconfig.xml.

#pragma once

#include <optional>

#include "deploy/attributes.h"
#include "deploy/element.h"
#include "deploy/io_config.h"
#include "deploy/report.h"

namespace indurop::deploy {

// Reads the point, whatever is wrong with it is reported.
IoPoint read_io_point(const Element& element, const IoDevice& device, Report& report);

// Attribute "unit" of a Modbus device or point.
std::optional<int> read_unit(Attributes& attributes, IoDriver driver);

// What the points of a device say together: two that are the same, or half of another.
void check_io_points(const IoDevice& device, Report& report);

}  // namespace indurop::deploy
