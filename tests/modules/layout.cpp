// SPDX-License-Identifier: Apache-2.0
// Built from several versions of one .glb file. Counts its runs in x.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdint>
#include <stdexcept>

namespace {
[[maybe_unused]] int runs_of_this_version = 0;
std::int64_t kept = 0;
}  // namespace

void onRun() {
#if defined(LAYOUT_THROWS)
  if (++runs_of_this_version > 20) {
    throw std::runtime_error("out of oil");
  }
#endif
  INDUROP_TYPEOF(nt_layout::axis)::value_type v = nt_layout::axis;
  v.x += 1;
  ++kept;
  v.speed = 2;
  nt_layout::axis = v;
}

INDUROP_STATE(kept)
INDUROP_MODULE(run = &::onRun)
