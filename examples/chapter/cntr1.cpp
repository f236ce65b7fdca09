// Every fifth basic period (500 us): a slower control law, started with a property of its <module>.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace knu::Robot;

namespace {
int gain = 1;
}

void onStart() { gain = irp::property<int>("intialize value", 1); }

void onRun() {
  // Several changes that others see as one.
  auto all = lock(joints);
  all[1].x = all[0].x * gain;
  all[1].y = all[0].y * gain;
}

INDUROP_MODULE(run = &::onRun, start = &::onStart, name = "cntr1", description = "scales the angles")
