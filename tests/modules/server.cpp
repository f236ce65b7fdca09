// SPDX-License-Identifier: Apache-2.0
// A thread module that implements nt::add and has otherwise nothing to do. Property "good_calls": how many it answers
// before one crashes; 0: all.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <csignal>

namespace {

int good_calls = 0;
int calls = 0;

double add(double a, double b) {
  if (++calls > good_calls && good_calls > 0) {
    std::raise(SIGSEGV);
  }
  return a + b;
}

}  // namespace

INDUROP_IMPLEMENT(nt::add, add)

void onStart() {
  good_calls = irp::property<int>("good_calls", 0);
}

void onRun() {}

INDUROP_MODULE(run = &::onRun, start = &::onStart)
