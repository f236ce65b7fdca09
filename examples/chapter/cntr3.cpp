// The first module of every basic period (100 us): reads the sensors. Here they are simulated: two angles that rise until
// an event module has noticed that they reached their limit.
#include <indurop/indurop.h>
#include <indurop/generated.h>

namespace {
unsigned limits_known = 0;
unsigned vision_known = 0;
}  // namespace

void onRun() {
  knu::Robot::tick += 1;
  auto angles = lock(joint);  // both angles change as one
  angles[0].x += 0.02;
  angles[1].y += 0.03;
  if (limits_reached != limits_known) {
    limits_known = limits_reached;
    angles[0].x = 0;
  }
  if (seen_by_vision != vision_known) {
    vision_known = seen_by_vision;
    angles[1].y = 0;
  }
}

INDUROP_MODULE(run = &::onRun, name = "cntr3", description = "reads the sensors")
