// SPDX-License-Identifier: Apache-2.0
// What an FMU device of ioconfig.xml needs of its FMU: the points, the start values, the variables that it declares.

#pragma once

#include <vector>

#include "config/model/io_config.h"
#include "core/base/diagnostics.h"
#include "core/schema/schema.h"

namespace indurop::config {

struct FmuPoints {
  std::vector<IoPoint> points;                // one for each number: arrays are taken apart
  std::vector<base::Diagnostic> diagnostics;  // of the FMU itself
};
// Reads the FMU and checks points and start values of the device with it; errors in ioconfig.xml go to `report`. Not
// real-time safe.
FmuPoints read_fmu_points(const IoDevice& device, base::Diagnostics& report);

// The shared variables that devices with variables="press" declare, for their inputs and outputs. Nothing of FMUs that
// cannot be read: read_fmu_points() reports why.
schema::Schema fmu_variables(const IoConfig& config);

}  // namespace indurop::config
