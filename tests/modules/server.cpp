// SPDX-License-Identifier: Apache-2.0
// A thread module that implements nt::add and has otherwise nothing to do.
#include <indurop/generated.h>
#include <indurop/indurop.h>

INDUROP_IMPLEMENT(nt::add, [](double a, double b) { return a + b; })

void onRun() {}

INDUROP_MODULE(run = &::onRun)
