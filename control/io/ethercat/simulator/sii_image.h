// SPDX-License-Identifier: Apache-2.0
// The EEPROM image of a simulated slave, from what its reader would find in it.

#pragma once

#include <cstdint>
#include <vector>

#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

// Texts are collected from names; Sii::strings is not read.
std::vector<std::uint8_t> sii_image(const Sii& sii);

}  // namespace indurop::io::ethercat
