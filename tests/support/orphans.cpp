// SPDX-License-Identifier: Apache-2.0
#include "tests/support/orphans.h"

#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/wait_until.h"

namespace indurop::test {

void inherit_orphans() {
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1) != 0) {
    std::abort();
  }
}

bool end_children() {
  return wait_until([] {
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
      std::ifstream children(thread.path() / "children");
      for (pid_t child = 0; children >> child;) {
        ::kill(child, SIGKILL);
      }
    }
    pid_t ended = 0;
    do {
      ended = ::waitpid(-1, nullptr, WNOHANG);
    } while (ended > 0);
    return ended < 0;  // ECHILD: none is left
  });
}

}  // namespace indurop::test
