// A sporadic thread module of plain C symbols.
#include <indurop/generated.h>

extern "C" int condition() {
  return knu::Robot::joints[0].x >= 180 ? 1 : 0;
}

extern "C" void run() {
  PLC_ROBOT::I0 = 1;
  for (int k = 0; k < 6; k++)
    PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[k] = 0.0;
}
