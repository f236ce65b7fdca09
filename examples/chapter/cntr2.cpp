// The second module of every basic period (100 us): computes from what cntr3 has just read, so nothing is old.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace knu::Robot;

void onRun() {
  constexpr double kSmoothing = 0.05;
  joints[0].x += kSmoothing * (joint[0].x - joints[0].x);
  joints[0].y += kSmoothing * (joint[1].y - joints[0].y);
}

INDUROP_MODULE(run = &::onRun, name = "cntr2", description = "smooths the angles")
