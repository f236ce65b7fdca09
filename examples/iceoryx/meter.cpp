// SPDX-License-Identifier: Apache-2.0
// Measures. Knows nothing of those who read.
#include <indurop/indurop.h>

#include <indurop/generated.h>

using namespace meter;

namespace {

uint64_t count = 0;

}  // namespace

void onRun() {
  Reading now{};
  now.count = ++count;
  now.litres = 0.5 * static_cast<double>(count);
  now.backwards = -static_cast<int32_t>(count);
  now.odd = count % 2 == 1;
  reading = now;
}

INDUROP_MODULE(run = &::onRun)
