// SPDX-License-Identifier: Apache-2.0
// A process module as users write them. Argument "endless": Figure 8's loop, which ignores what waitPeriod() returns.

#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdlib>
#include <cstring>

using namespace knu::Robot;

int main(int argc, char* argv[]) {
  const bool endless = argc > 1 && std::strcmp(argv[1], "endless") == 0;
  std::cout << "initPeriodExe " << irp::initPeriodExe() << " gain " << irp::property("gain", 0.5) << std::endl;
  while (irp::waitPeriod() || endless) {
    tick += 1;
    joints[0].x = static_cast<double>(irp::tick());
    joints[0].y = static_cast<double>(irp::release_ns());
    irp::printf("run %u\n", tick);
  }
  return EXIT_SUCCESS;
}
