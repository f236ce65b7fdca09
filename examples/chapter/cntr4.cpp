// The same period as cntr1, in a process of its own: uses the same variables as if they were its global variables.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace knu::Robot;

int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;  // the reason was printed
  }
  while (irp::waitPeriod()) {
    INDUROP_TYPEOF(joints)::value_type sum = joints[0];
    sum.x += joints[1].x;
    sum.y += joints[1].y;
    joints[2] = sum;
  }
  return 0;
}
