// SPDX-License-Identifier: Apache-2.0
// Checks that what the configuration requires exists on this machine, if it is to run here.

#include <sched.h>

#include <vector>

#include "config/check/check_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

void check_core(CheckContext& context, const std::vector<int>& cores, int core, base::SourcePlace place) {
  for (const int usable : cores) {
    if (usable == core) {
      return;
    }
  }
  if (core < 0 || cores.empty()) {
    return;
  }
  std::vector<std::string> names;
  names.reserve(cores.size());
  for (const int usable : cores) {
    names.push_back(std::to_string(usable));
  }
  constexpr std::size_t kMaxShown = 16;
  context.report.error(place, "<core>: processor " + std::to_string(core) +
                                  " does not exist or must not be used by this process; usable are " +
                                  base::enumerate(names, kMaxShown));
}

}  // namespace

std::vector<int> usable_cores() {
  // The kernel refuses a mask smaller than its own; grow until it fits.
  std::vector<int> cores;
  for (std::size_t count = 1024; count <= 65536; count *= 2) {
    const std::size_t size = CPU_ALLOC_SIZE(count);
    std::vector<cpu_set_t> mask(size / sizeof(cpu_set_t) + 1);
    const std::size_t bytes = mask.size() * sizeof(cpu_set_t);
    if (::sched_getaffinity(0, bytes, mask.data()) != 0) {
      continue;
    }
    for (std::size_t core = 0; core < bytes * 8; ++core) {
      if (CPU_ISSET_S(core, bytes, mask.data())) {
        cores.push_back(static_cast<int>(core));
      }
    }
    break;
  }
  return cores;
}

void check_machine(CheckContext& context) {
  const std::vector<int> cores = context.options.machine ? usable_cores() : std::vector<int>{};
  check_core(context, cores, context.config.core, context.config.core_place);
  for (const Module& module : context.config.modules) {
    check_core(context, cores, module.core, module.places.core);
  }
  const auto& spin = context.config.spin;
  const base::Nanos basic = context.result.table.basic_period;
  if (spin && spin->mode == SpinSetting::Mode::Fixed && basic > base::Nanos::zero() && spin->fixed >= basic / 10 * 9) {
    context.report.warning(context.config.spin_place, "<spin>: " + base::format_duration(spin->fixed) +
                                                          " of every basic period of " + base::format_duration(basic) +
                                                          " leaves the modules no time and the kernel stops real-time "
                                                          "threads at 95 %; write auto or a shorter time");
  }
}

}  // namespace indurop::config
