// SPDX-License-Identifier: Apache-2.0
// Sporadic, but without a function that says whether its event has occurred.
#include <indurop/indurop.h>

#include <stdexcept>

bool has_occurred() {
  throw std::runtime_error("no idea");
}
void onRun() {}

INDUROP_MODULE(run = &::onRun, condition = &::has_occurred)
