// SPDX-License-Identifier: Apache-2.0
// Calls nt::add in every run and keeps account of what came back.
#include <indurop/generated.h>
#include <indurop/indurop.h>

void onRun() {
  if (auto result = nt::add(2.0, 3.0); result.ok()) {
    nt::sum = result.value();
    ++nt::answers;
  } else {
    nt::failure = static_cast<int>(result.error());
    ++nt::failures;
  }
}

INDUROP_MODULE(run = &::onRun)
