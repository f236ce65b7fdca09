// SPDX-License-Identifier: Apache-2.0
// Walks on, from what counter.so counted, a state of its own and the time that it read. STEP is 3, and 4 in
// new/walker.so.
#include <indurop/generated.h>
#include <indurop/indurop.h>

namespace {
std::int64_t own = 0;
}  // namespace

extern "C" void run() {
  own += STEP;
  nt::walked += own % 7 + nt::counted % 5 + irp::now_ns() % 3;
  nt::pace = {nt::walked, static_cast<double>(own) / 8};
}
