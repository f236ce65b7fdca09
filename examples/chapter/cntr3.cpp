// The first module of every basic period (100 us): reads the sensors. Here they are simulated: two angles that rise.
#include <indurop/indurop.h>
#include <indurop/generated.h>

void onRun() {
  knu::Robot::tick += 1;
  joint[0].x += 0.02;
  joint[1].y += 0.03;
}

INDUROP_MODULE(run = &::onRun, name = "cntr3", description = "reads the sensors")
