// SPDX-License-Identifier: Apache-2.0
// A slave that lets its master fill its PDOs.

#pragma once

#include <vector>

#include "control/io/ethercat/master/mapping.h"
#include "slaves.h"

namespace indurop::io::ethercat {

// A slave all of whose PDOs may be filled, with these objects.
struct Fillable {
  Sii sii = drive_sii();
  SlaveConfig config;

  Fillable(const std::vector<WantedObject>& outputs, const std::vector<WantedObject>& inputs) {
    sii.coe_details |= kCoePdoAssign | kCoePdoConfiguration;
    sii.outputs.push_back({0x1601, kNotAssigned, 0, "", {}});
    sii.inputs.push_back({0x1A01, kNotAssigned, 0, "", {}});
    sii.sync_managers[3].start = 0x1200;
    config = drive_config();
    config.esc.eeprom = sii_image(sii);
    config.objects.add_number<std::uint16_t>(0x6040, 0, 0);
    config.objects.add_number<std::int32_t>(0x607A, 0, 0);
    config.objects.add_number<std::uint16_t>(0x6041, 0, 0, false);
    config.objects.add_number<std::int32_t>(0x6064, 0, 0, false);
    for (const WantedObject& object : outputs) {
      config.objects.add(object.index, object.subindex, std::vector<std::uint8_t>(object.bits / 8));
    }
    for (const WantedObject& object : inputs) {
      config.objects.add(object.index, object.subindex, std::vector<std::uint8_t>(object.bits / 8), false);
    }
  }
};

}  // namespace indurop::io::ethercat
