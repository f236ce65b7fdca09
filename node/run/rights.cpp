// SPDX-License-Identifier: Apache-2.0
#include "node/run/rights.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/rt/copy_text.h"
#include "core/rt/thread.h"
#include "scheduler/bands.h"
#include "scheduler/run_block.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

extern "C" {
[[gnu::weak, gnu::visibility("hidden")]] extern const char kColdCodeBegin;
[[gnu::weak, gnu::visibility("hidden")]] extern const char kColdCodeEnd;
}

namespace indurop::node {
namespace {

// Returns the code that cold_rooms.ld groups; nothing if the linker does not support such scripts.
std::span<const char> cold_code() noexcept {
  const char* const begin = &kColdCodeBegin;
  return begin == nullptr ? std::span<const char>() : std::span(begin, &kColdCodeEnd);
}

// Counts the real-time nodes that run on this host and have their tick on the core.
std::ptrdiff_t ticks_on(int core) {
  const std::vector<std::string> names = vars::list_nodes(vars::Nodes::All);
  return std::count_if(names.begin(), names.end(), [core](const std::string& name) {
    const auto run = vars::RunFile::open(name, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    const pid_t holder = vars::running_node(name);
    if (!run || holder == 0 || holder == ::getpid()) {  // our own name: left by an earlier run
      return false;
    }
    const auto* block = static_cast<const scheduler::RunBlock*>(run->data());
    return block->abi == scheduler::kRunAbi && block->obtained.tick_core == core;
  });
}

// Returns the last one of the cores with the fewest ticks: interrupts go to the first ones.
int free_core(const std::vector<int>& cores) {
  const auto best =
      std::min_element(cores.rbegin(), cores.rend(), [](int a, int b) { return ticks_on(a) < ticks_on(b); });
  return best == cores.rend() ? 0 : *best;
}

}  // namespace

Result<Rights, Ending> obtain_rights(const Options& options, const config::Config& config, const Console& console) {
  Rights rights;
  const auto cores = rt::allowed_cores();
  if (options.core || config.core >= 0) {
    rights.core = options.core.value_or(config.core);
    if (std::find(cores.begin(), cores.end(), rights.core) == cores.end()) {
      console.error("core {} cannot be used by this process; it may use {}", rights.core, fmt::join(cores, ", "));
      return Ending{kUsage};
    }
  } else {
    rights.core = free_core(cores);
  }
  const Status fifo = rt::set_fifo(scheduler::kTickPriority);
  scheduler::Obtained& obtained = rights.obtained;
  obtained.fifo = fifo.ok() ? 1 : 0;
  (void)rt::set_fifo(0);
  obtained.tick_priority = fifo.ok() ? scheduler::kTickPriority : 0;
  obtained.pinned = obtained.fifo;
  obtained.tick_core = fifo.ok() ? rights.core : -1;
  if (auto idle = rt::ShortIdle::hold(); idle) {
    rights.idle = std::move(idle).value();
    obtained.cpu_dma_latency = 1;
  }
  obtained.preempt_rt = rt::kernel_is_preempt_rt() ? 1 : 0;
  obtained.throttle_permille = static_cast<std::uint32_t>(rt::throttle_permille());
  if (!fifo.ok()) {
    rt::copy_text(obtained.why,
                  "SCHED_FIFO refused: run as root, or give the user rtprio 95 and memlock unlimited in "
                  "/etc/security/limits.d, or the program CAP_SYS_NICE and CAP_IPC_LOCK");
    if (options.require_rt) {
      console.error("real-time privileges not obtained (--require-rt): {}", obtained.why);
      return Ending{kNoRealTime};
    }
    console.warning("NOT REAL TIME: {}. Order is kept, timing is best effort", obtained.why);
  }
  return rights;
}

Rights simulated_rights(const Options& options, const config::Config& config) {
  Rights rights;
  rights.core = std::max(options.core.value_or(config.core), 0);
  rights.obtained.tick_core = -1;
  rt::copy_text(rights.obtained.why, "simulation: virtual time needs no real-time privileges");
  return rights;
}

Result<void, Ending> lock_memory(const Options& options, const Rights& rights, scheduler::RunBlock& run,
                                 const Console& console) {
  // Used at start-up, and by the threads for recording and for communication with other boards, which are not
  // real-time.
  constexpr std::array<std::string_view, 7> kNotNeeded{"libddsc",     "libcrypto", "libssl", "libiceoryx",
                                                       "libtinyxml2", "libzstd",   "liblz4"};
  if (const Status locked = rt::lock_memory(kNotNeeded, cold_code()); locked) {
    run.obtained.memory_locked = 1;
  } else if (rights.realtime()) {
    rt::copy_text(run.obtained.why, "mlockall refused: raise the limit of locked memory (memlock unlimited)");
    if (options.require_rt) {
      console.error("real-time privileges not obtained (--require-rt): {}", run.obtained.why);
      return Ending{kNoRealTime};
    }
    console.warning("memory is not locked: {}", run.obtained.why);
  }
  return {};
}

std::vector<int> cores_without_modules(const config::Config& config, const Rights& rights) {
  std::vector<int> cores = rt::allowed_cores();
  std::erase_if(cores, [&](int core) {
    return core == rights.core || std::any_of(config.modules.begin(), config.modules.end(),
                                              [core](const config::Module& module) { return module.core == core; });
  });
  return cores;
}

config::SpinSetting spin_setting(const Options& options, const config::Config& config) {
  return options.spin.value_or(config.spin.value_or(config::SpinSetting{}));
}

}  // namespace indurop::node
