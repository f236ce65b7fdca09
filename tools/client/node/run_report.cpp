// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/run_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>

#include "config/xml/reader.h"
#include "core/rt/clock.h"
#include "core/rt/relaxed.h"
#include "deploy/words/deployment_words.h"
#include "store/vars/node_lock.h"
#include "store/vars/store.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

std::vector<std::string> nodes_on(std::int32_t core, const std::string& but) {
  std::vector<std::string> names = vars::list_nodes();
  std::erase_if(names, [core, &but](const std::string& name) {
    if (name == but) {
      return true;
    }
    const auto run = RunView::open(name);
    return !run.ok() || !run->node_alive() || run->block().obtained.tick_core != core;
  });
  return names;
}

// Returns true if its process exists but does not continue: its supervisor sends a heartbeat every 10 ms.
bool is_hung(const std::string& node, bool alive, scheduler::NodeState state) {
  constexpr std::chrono::seconds kLongest{5};
  const auto beat = alive && state == scheduler::NodeState::Running ? vars::last_beat(node) : Error{Errc::NotFound};
  return beat && rt::MonoClock::now() - *beat > kLongest;
}

}  // namespace

void set_owner(NodeReport& report) {
  if (const auto owner = vars::owner_of(report.node)) {
    report.owner = vars::user_name(*owner);
    report.foreign = *owner != ::geteuid();
  }
}

NodeReport report_of(const std::string& node, const RunView& run) {
  using rt::kRelaxed;
  const auto& block = run.block();
  NodeReport report;
  report.node = node;
  report.alive = run.node_alive();
  const auto state = block.state.load(kRelaxed);
  const bool ended = state == scheduler::NodeState::Stopped || state == scheduler::NodeState::Failed;
  report.state = report.alive || ended ? to_text(state) : "killed";
  if (run.here()) {
    set_owner(report);
    report.state = is_hung(node, report.alive, state) ? kHung : report.state;
  }
  report.pid = block.node_pid.load(kRelaxed);
  report.config_file = fixed_text(block.config_file);
  report.deployment = fixed_text(block.deployment);
  report.stop_reason = fixed_text(block.stop_reason);
  report.basic_period_ns = block.basic_period_ns;
  report.macro_period_ns = block.macro_period_ns;
  report.schedule = block.schedule.load(std::memory_order_acquire);
  report.schedule_tick = block.schedule_tick.load(kRelaxed);
  report.schedule_file = fixed_text(block.schedule_files[report.schedule % 2]);
  report.ticks = block.tick.load(kRelaxed);
  report.lost_ticks = block.lost_ticks.load(kRelaxed);
  if (report.alive && block.epoch_ns > 0) {
    report.uptime_ns = std::max<std::int64_t>(0, run.now_ns() - block.epoch_ns);
  }
  report.modules = run.module_count();
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    report.overruns += run.module(i).overruns.load(kRelaxed);
    report.faults += run.module(i).faults.load(kRelaxed);
  }
  report.rt = block.obtained;
  if (report.alive && run.here() && report.rt.pinned != 0) {
    report.same_core = nodes_on(report.rt.tick_core, node);
  }
  report.lateness = scheduler::summarize(block.tick_lateness);
  report.pulse_after_ns = block.pulse_after_ns.load(kRelaxed);
  report.pulse_wanted_ns = block.pulse_wanted_ns.load(kRelaxed);
  return report;
}

std::string rt_text(const scheduler::Obtained& rt) {
  std::string text = rt.fifo != 0 ? fmt::format("FIFO {}", rt.tick_priority) : "no FIFO";
  if (rt.pinned != 0) {
    text += fmt::format(" on core {}", rt.tick_core);
  }
  text += rt.memory_locked != 0 ? ", memory locked" : ", memory not locked";
  text += rt.cpu_dma_latency != 0 ? ", idle states held short" : ", idle states not held short";
  text += rt.preempt_rt != 0 ? ", PREEMPT_RT kernel" : ", kernel without PREEMPT_RT";
  return text;
}

JsonValue json_of(const NodeReport& report) {
  return {{"node", report.node},
          {"running", report.alive},
          {"state", report.state},
          {"pid", report.alive ? JsonValue(report.pid) : JsonValue()},
          {"config_file", report.config_file},
          {"deployment", report.deployment.empty() ? JsonValue() : JsonValue(report.deployment)},
          {"stop_reason", report.stop_reason},
          {"uptime_ns", report.uptime_ns},
          {"basic_period_ns", report.basic_period_ns},
          {"macro_period_ns", report.macro_period_ns},
          {"schedule", report.schedule},
          {"schedule_tick", report.schedule_tick},
          {"schedule_file", report.schedule_file},
          {"ticks", report.ticks},
          {"lost_ticks", report.lost_ticks},
          {"lateness_ns",
           {{"min", report.lateness.min},
            {"mean", report.lateness.mean},
            {"p50", report.lateness.p50},
            {"p99", report.lateness.p99},
            {"p99_9", report.lateness.p99_9},
            {"max", report.lateness.max}}},
          {"pulse_ns", report.pulse_wanted_ns == 0
                           ? JsonValue()
                           : JsonValue({{"after", report.pulse_after_ns}, {"wanted", report.pulse_wanted_ns}})},
          {"rt",
           {{"fifo", report.rt.fifo != 0},
            {"priority", report.rt.tick_priority},
            {"memory_locked", report.rt.memory_locked != 0},
            {"cpu_dma_latency", report.rt.cpu_dma_latency != 0},
            {"pinned", report.rt.pinned != 0},
            {"core", report.rt.tick_core},
            {"same_core", JsonValue(report.same_core)},
            {"preempt_rt", report.rt.preempt_rt != 0},
            {"throttle_permille", report.rt.throttle_permille},
            {"why", fixed_text(report.rt.why)}}},
          {"owner", report.owner.empty() ? JsonValue() : JsonValue(report.owner)}};
}

}  // namespace indurop::tools
