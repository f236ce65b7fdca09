// The same period as cntr1, in a process of its own: uses the same variables as if they were its global variables.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace knu::Robot;

int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;  // the reason was printed
  }
  while (irp::waitPeriod()) {
    INDUROP_TYPEOF(total)::value_type sum = scaled;
    sum.x += joints[0].x;
    sum.y += joints[0].y;
    total = sum;
  }
  return 0;
}
