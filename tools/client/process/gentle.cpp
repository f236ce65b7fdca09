// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/gentle.h"

#include <sched.h>
#include <sys/resource.h>

#include "tools/client/node/run_view.h"

namespace indurop::tools {

void be_gentle(const std::string& node) {
  const sched_param normal{};
  sched_setscheduler(0, SCHED_OTHER, &normal);
  constexpr int kNice = 5;
  if (getpriority(PRIO_PROCESS, 0) < kNice) {
    setpriority(PRIO_PROCESS, 0, kNice);
  }
  const auto run = RunView::open(node);
  if (!run.ok() || run.value().block().obtained.pinned == 0) {
    return;
  }
  const int core = run.value().block().obtained.tick_core;
  cpu_set_t allowed;
  if (core < 0 || core >= CPU_SETSIZE || sched_getaffinity(0, sizeof allowed, &allowed) != 0) {
    return;
  }
  CPU_CLR(static_cast<unsigned>(core), &allowed);
  if (CPU_COUNT(&allowed) > 0) {
    sched_setaffinity(0, sizeof allowed, &allowed);
  }
}

}  // namespace indurop::tools
