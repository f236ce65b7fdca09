// SPDX-License-Identifier: Apache-2.0
// Counts its runs in all places of its board's retained variables; prints what it finds in them, and every tenth run.
// BOARD is the namespace.
#include <algorithm>

#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {

using Count = INDUROP_TYPEOF(BOARD::count)::value_type;

void print_restored(const Count& found) {
  const auto [least, most] = std::minmax_element(found.many.begin(), found.many.end());
  irp::printf("restored %llu %llu %llu %llu %llu\n", static_cast<unsigned long long>(found.runs),
              static_cast<unsigned long long>(found.again), static_cast<unsigned long long>(*least),
              static_cast<unsigned long long>(*most), static_cast<unsigned long long>(BOARD::last));
}

bool has_run = false;

}  // namespace

void on_run() {
  Count next = BOARD::count;
  if (!has_run) {
    has_run = true;
    print_restored(next);
  }
  ++next.runs;
  next.again = next.runs;
  next.many.fill(next.runs);
  BOARD::count = next;
  BOARD::last = next.runs;
  if (next.runs % 10 == 0) {
    irp::printf("run %llu\n", static_cast<unsigned long long>(next.runs));
  }
}

INDUROP_MODULE(run = &::on_run)
