// SPDX-License-Identifier: Apache-2.0
// A process module that behaves as its first argument says.
//   count           runs until it is commanded to end
//   exit N          ends at once with this code
//   never           lives, but never enrols
//   deaf            enrols, then neither waits again nor minds SIGTERM
//   loop N          never returns from run N
//   die N           SIGKILLs itself in run N
//   change N        SIGKILLs itself when the count of counter.so has passed a multiple of N since it was started
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string_view>

int main(int argc, char** argv) {
  const std::string_view how = argc > 1 ? argv[1] : "count";
  const int number = argc > 2 ? std::atoi(argv[2]) : 0;
  if (how == "exit") {
    return number;
  }
  if (how == "never") {
    for (;;) {
      ::pause();
    }
  }
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  const std::uint32_t each = how == "change" ? static_cast<std::uint32_t>(number) : 0;
  const std::uint32_t at_first = each > 0 ? nt::counted / each : 0;
  int runs = 0;
  while (irp::waitPeriod()) {
    ++nt::process_runs;
    ++runs;
    if (how == "deaf") {
      std::signal(SIGTERM, SIG_IGN);
      for (;;) {
        ::pause();
      }
    }
    if (how == "loop" && runs == number) {
      for (volatile bool forever = true; forever;) {
      }
    }
    if ((how == "die" && runs == number) || (each > 0 && nt::counted / each != at_first)) {
      ::kill(::getpid(), SIGKILL);
    }
  }
  return 0;
}
