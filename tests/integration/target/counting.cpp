// SPDX-License-Identifier: Apache-2.0
// Counts its runs in all places of the retained variables, and prints every fiftieth run.
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {

using Count = INDUROP_TYPEOF(kept::count)::value_type;

}  // namespace

void on_run() {
  Count next = kept::count;
  ++next.runs;
  next.again = next.runs;
  next.many.fill(next.runs);
  kept::count = next;
  kept::last = next.runs;
  if (next.runs % 50 == 0) {
    irp::printf("run %llu\n", static_cast<unsigned long long>(next.runs));
  }
}

INDUROP_MODULE(run = &::on_run)
