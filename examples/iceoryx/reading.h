// SPDX-License-Identifier: Apache-2.0
// meter::Reading of meter.glb, as programs see it that know nothing of InduRoP. For C and C++. Offsets and size are
// those of build/examples/iceoryx/meter_glb.generated/meter.layout.txt.

#pragma once

#include <assert.h>
#include <stdint.h>

typedef struct {
  uint64_t count;
  double litres;
  int32_t backwards;
  uint8_t odd;
} meter_Reading;

static_assert(sizeof(meter_Reading) == 24, "another layout than the module's");
