// SPDX-License-Identifier: Apache-2.0
// Implements nt::add by chance, so that no two calls give the same.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <random>

INDUROP_IMPLEMENT(nt::add, [](double a, double b) {
  static std::random_device chance;
  return a + b + static_cast<double>(chance());
})

void onRun() {}

INDUROP_MODULE(run = &::onRun)
