// SPDX-License-Identifier: Apache-2.0
// Built twice, from two versions of one .glb file.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  INDUROP_TYPEOF(nt_layout::axis)::value_type v = nt_layout::axis;
  v.x += 1;
  v.speed = 2;
  nt_layout::axis = v;
}

INDUROP_MODULE(run = &::onRun)
