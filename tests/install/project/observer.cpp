// A periodic process module.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdio>

int main() {
  irp::initPeriodExe();
  for (;;) {
    irp::waitPeriod();
    if (knu::Robot::tick % 1000 == 0) {
      std::printf("tick %u\n", static_cast<unsigned>(knu::Robot::tick));
    }
  }
}
