// SPDX-License-Identifier: Apache-2.0
// Explains why a module did not run in a tick, or ended late: checks one possible reason after the other.

#include <fmt/format.h>

#include <algorithm>

#include "history/explain/lateness.h"
#include "history/explain/questions.h"
#include "history/explain/words.h"

namespace indurop::explain {
namespace {

// The ticks for which a module's runs are known. Ring buffers hold more of one module than of another, and are copied
// one after the other: at both ends of the known range a missing run may only be one that was not kept.
struct Known {
  static constexpr std::int64_t kCopiedNs = 100'000'000;

  Known(const Facts& all, std::uint32_t module) : facts(all) {
    for (const RunFact& run : facts.runs) {
      if (run.module == module) {
        first = std::min(first, run.tick);
        last = last == kNone ? run.tick : std::max(last, run.tick);
      }
    }
  }
  [[nodiscard]] bool at(std::uint64_t tick) const {
    if (last == kNone) {
      return true;
    }
    const bool before = facts.first_tick > 0 && tick < first;
    const bool behind = facts.closed && tick > last && facts.release_of(tick) + kCopiedNs > facts.now_ns;
    return !before && !behind;
  }

  const Facts& facts;
  std::uint64_t first = kNone;
  std::uint64_t last = kNone;
};

class Question {
 public:
  Question(const Facts& facts, const ModuleFact& module, std::uint64_t tick)
      : facts_(facts),
        module_(module),
        index_(static_cast<std::uint32_t>(&module - facts.modules.data())),
        tick_(tick),
        release_ns_(facts.release_of(tick)),
        lateness_(facts) {}

  Answer answer() {
    if (module_.operation == "non-real") {
      return {Cause::NotDue,
              {},
              fmt::format("{} is not part of the schedule: it runs in the background", module_.name),
              {}};
    }
    const RunFact* run = find(tick_);
    if (run != nullptr && run->faulted) {
      return faulted(*run);
    }
    if (tick_ < facts_.schedule_tick) {
      return not_known(fmt::format("it belongs to another schedule; the one that is known counts since tick {}",
                                   facts_.schedule_tick));
    }
    if (run != nullptr) {
      return lateness_.explain(*run);
    }
    if (tick_ < facts_.first_tick) {
      return not_known(fmt::format("data is available from tick {} on", facts_.first_tick));
    }
    for (Answer one : {not_there(), not_due(), not_recorded(), after_fault(), stopped(), restarting()}) {
      if (!one.text.empty()) {
        return one;
      }
    }
    if (module_.operation == "sporadic") {
      return {Cause::NotDue, {}, fmt::format("{} runs on its event, and did not in {}", module_.name, place()), {}};
    }
    if (const Known known(facts_, index_); !known.at(tick_)) {
      return not_known(fmt::format("of {} the ticks {} to {} are known", module_.name, known.first, known.last));
    }
    return kept_out();
  }

 private:
  [[nodiscard]] std::string place() const { return at_tick(facts_, tick_); }

  [[nodiscard]] const RunFact* find(std::uint64_t tick) const {
    const auto found = std::find_if(facts_.runs.begin(), facts_.runs.end(),
                                    [&](const RunFact& run) { return run.module == index_ && run.tick == tick; });
    return found == facts_.runs.end() ? nullptr : &*found;
  }

  [[nodiscard]] Answer not_there() const {
    if (tick_ < facts_.tick) {
      return {};
    }
    if (facts_.alive) {
      return not_known(fmt::format("tick {} is still to come: the node is at {}", tick_, facts_.tick));
    }
    if (facts_.closed && facts_.stop_reason.empty()) {
      return not_known(fmt::format("what is recorded ends with tick {}", facts_.tick));
    }
    return {Cause::Stopped,
            {},
            fmt::format("the node had ended at tick {}{}", facts_.tick,
                        facts_.stop_reason.empty() ? "" : ": " + facts_.stop_reason),
            {}};
  }

  [[nodiscard]] Answer not_due() const {
    if (module_.period_ns <= 0 || facts_.basic_period_ns <= 0) {
      return {};
    }
    const std::uint64_t every = facts_.ticks_between_runs(module_);
    const std::uint64_t first = facts_.ticks_in(module_.offset_ns);
    if (tick_ >= first && (tick_ - first) % every == 0) {
      return {};
    }
    const std::uint64_t next = tick_ < first ? first : first + ((tick_ - first) / every + 1) * every;
    return {Cause::NotDue,
            {},
            fmt::format("{} is not due in {}: it runs in every {}th tick, next in tick {}", module_.name, place(),
                        every, next),
            {}};
  }

  // A damaged file, a missing part, or a recorder that could not keep up.
  [[nodiscard]] Answer not_recorded() const {
    const HoleFact* const hole = facts_.hole_around(index_, tick_);
    if (hole == nullptr) {
      return {};
    }
    return not_known(fmt::format("the recording lacks {} {} of {} between the ticks {} and {}", hole->runs,
                                 hole->runs == 1 ? "run" : "runs", module_.name, hole->after_tick, hole->before_tick));
  }

  [[nodiscard]] Answer faulted(const RunFact& run) const {
    const bool known_to_end = module_.fault_tick == run.tick && !module_.fault.empty();
    Answer answer{Cause::Fault,
                  module_.name,
                  fmt::format("the run of {} in {} ended by a fault{}", module_.name, place(),
                              known_to_end ? ": " + module_.fault : ""),
                  {}};
    return answer;
  }

  [[nodiscard]] const RunFact* last_before(std::uint64_t tick) const {
    const RunFact* last = nullptr;
    for (const RunFact& run : facts_.runs) {
      last = run.module == index_ && run.tick < tick ? &run : last;
    }
    return last;
  }

  // The newest fault is known with its reason; of older ones only that the run ended with a fault.
  [[nodiscard]] Answer after_fault() const {
    const RunFact* before = last_before(tick_);
    // A run in which a process died may have no end, and its death is detected a little later.
    const std::uint64_t every = facts_.ticks_between_runs(module_);
    const std::uint64_t seen = tick_ + (module_.type == "process" ? every : 0);
    const bool newest = module_.faults > 0 && module_.fault_tick <= seen && !module_.fault.empty() &&
                        (before == nullptr || before->tick <= module_.fault_tick) &&
                        !ran_between(module_.fault_tick + 1, tick_);
    if (!newest && before != nullptr && before->faulted) {
      return {Cause::Fault,
              module_.name,
              fmt::format("the run of {} in {} ended by a fault, after which it did not run until {}", module_.name,
                          at_tick(facts_, before->tick), place()),
              {}};
    }
    if (!newest || module_.restarts > 0 || module_.state == "restarting") {
      return {};
    }
    return {Cause::Fault,
            module_.name,
            fmt::format("{} faulted in tick {} and does not run any more: {}", module_.name, module_.fault_tick,
                        module_.fault),
            {fmt::format("faults: {}, state: {}", module_.faults, module_.state)}};
  }

  // The newest order before the tick shows it, or the module's state. An order is recorded when it has been executed.
  [[nodiscard]] Answer stopped() const {
    const OrderFact* last = nullptr;
    for (const OrderFact& order : facts_.orders) {
      constexpr std::int64_t kNotedLater = 100'000'000;
      const bool matches = order.action == "stop" || order.action == "start" || order.action == "restart";
      const bool obeyed = order.node_ns <= release_ns_ ||
                          (order.action == "stop" && order.node_ns <= release_ns_ + kNotedLater && stands_until(order));
      if (matches && order.what == module_.name && obeyed) {
        last = &order;
      }
    }
    if (last != nullptr && last->action == "stop") {
      return {Cause::Stopped,
              last->who,
              fmt::format("{} was stopped by {}", module_.name, who(*last)),
              {fmt::format("{}: stop {}", when(facts_, last->node_ns), module_.name)}};
    }
    if (module_.state == "stopped" && facts_.alive && !ran_after(tick_)) {
      return {Cause::Stopped, {}, fmt::format("{} was stopped; by whom was not noted", module_.name), {}};
    }
    return {};
  }

  [[nodiscard]] Answer restarting() const {
    if (module_.type != "process" || (module_.restarts == 0 && module_.state != "restarting") || module_.faults == 0) {
      return {};
    }
    const RunFact* before = nullptr;
    const RunFact* next = nullptr;
    for (const RunFact& run : facts_.runs) {
      if (run.module == index_) {
        before = run.tick < tick_ ? &run : before;
        next = run.tick > tick_ && next == nullptr ? &run : next;
      }
    }
    const bool died_between = (before == nullptr || before->tick <= module_.fault_tick) &&
                              (next == nullptr || module_.fault_tick <= next->tick);
    if (!died_between) {
      return {};
    }
    const bool stays = module_.state == "faulted" && next == nullptr && module_.fault_tick <= tick_;
    return {Cause::Fault,
            module_.name,
            fmt::format("the process of {} had died and {}: {}", module_.name,
                        stays ? "stays stopped after too many restarts" : "was being started again", module_.fault),
            {}};
  }

  [[nodiscard]] bool ran_between(std::uint64_t first, std::uint64_t last) const {
    return std::any_of(facts_.runs.begin(), facts_.runs.end(), [&](const RunFact& run) {
      return run.module == index_ && run.tick >= first && run.tick <= last;
    });
  }

  // Returns whether the module did not run from the tick to the order.
  [[nodiscard]] bool stands_until(const OrderFact& order) const {
    return std::none_of(facts_.runs.begin(), facts_.runs.end(), [&](const RunFact& run) {
      return run.module == index_ && run.end_ns > release_ns_ && run.start_ns < order.node_ns;
    });
  }

  [[nodiscard]] bool ran_after(std::uint64_t tick) const {
    return std::any_of(facts_.runs.begin(), facts_.runs.end(),
                       [&](const RunFact& run) { return run.module == index_ && run.tick > tick; });
  }

  // The module was due and could have run.
  [[nodiscard]] Answer kept_out() const {
    const RunFact* own = nullptr;
    bool any = false;  // another module had its core in this tick
    for (const RunFact& run : facts_.runs) {
      if (run.module == index_ && run.tick < tick_ && run.end_ns > release_ns_) {
        own = &run;
      }
      any =
          any || (on_its_core(run) && run.start_ns < release_ns_ + facts_.basic_period_ns && run.end_ns > release_ns_);
    }
    if (own != nullptr) {
      Answer answer = lateness_.explain(*own);
      answer.text =
          fmt::format("at its release in {} its run of tick {} was not over. {}", place(), own->tick, answer.text);
      return answer;
    }
    if (const RunFact* shared = of_its_thread(); shared != nullptr) {
      Answer answer = lateness_.explain(*shared);
      answer.text = fmt::format("at its release in {} the run of {} of tick {} was not over, after which it runs. {}",
                                place(), facts_.modules[shared->module].name, shared->tick, answer.text);
      return answer;
    }
    if (const auto* hole = facts_.hole_within(module_.core, release_ns_, release_ns_ + facts_.basic_period_ns)) {
      return not_known(
          fmt::format("{} did not run in {}, and the recording lacks runs of {} then, which may have kept it from it",
                      module_.name, place(), facts_.modules[hole->module].name));
    }
    const RunFact* holder = Timeline(facts_, module_.core).at(release_ns_);
    if (holder != nullptr && holder->tick < tick_) {
      Answer answer = lateness_.explain(*holder);
      answer.text = fmt::format("at the begin of {} the run of {} of tick {} was not over, and the tick was lost. {}",
                                place(), facts_.modules[holder->module].name, holder->tick, answer.text);
      return answer;
    }
    if (any) {
      return not_known(
          fmt::format("other modules ran in {}, and nothing on record kept {} from running", place(), module_.name));
    }
    return stood_still();
  }

  // Modules of one period on one core that run one after the other share one thread: it begins again when all are done.
  [[nodiscard]] const RunFact* of_its_thread() const {
    const RunFact* last = nullptr;
    for (const RunFact& run : facts_.runs) {
      if (run.tick < tick_ && on_its_core(run) && run.release_ns < release_ns_ && run.end_ns > release_ns_ &&
          facts_.modules[run.module].period_ns == module_.period_ns) {
        last = last == nullptr || run.end_ns > last->end_ns ? &run : last;
      }
    }
    return last;
  }

  [[nodiscard]] bool on_its_core(const RunFact& run) const { return facts_.modules[run.module].core == module_.core; }

  [[nodiscard]] Answer stood_still() const {
    Span gap{facts_.epoch_ns, facts_.now_ns};
    for (const RunFact& run : facts_.runs) {
      if (!on_its_core(run)) {
        continue;
      }
      if (run.end_ns <= release_ns_) {
        gap.from_ns = std::max(gap.from_ns, run.end_ns);
      }
      if (run.start_ns >= release_ns_) {
        gap.to_ns = std::min(gap.to_ns, run.start_ns);
      }
    }
    Answer answer = lateness_.machine({release_ns_, gap.to_ns}, module_.core, module_, gap.length());
    answer.cause = Cause::Machine;
    answer.text = fmt::format(
        "no module ran on core {} in {}: no thread of the node ran on it for {}, so the machine was suspended or "
        "preempted ({})",
        module_.core, place(), short_time(gap.length()), answer.text);
    answer.evidence.push_back(fmt::format("lost ticks: {}", facts_.lost_ticks));
    return answer;
  }

  const Facts& facts_;
  const ModuleFact& module_;
  std::uint32_t index_;
  std::uint64_t tick_;
  std::int64_t release_ns_;
  Lateness lateness_;
};

bool due(const Facts& facts, const ModuleFact& module, std::uint64_t tick) {
  const std::uint64_t every = facts.ticks_between_runs(module);
  const std::uint64_t first = facts.ticks_in(module.offset_ns);
  return tick >= first && (tick - first) % every == 0;
}

}  // namespace

Answer why_late(const Facts& facts, const std::string& module, std::uint64_t tick) {
  const ModuleFact* known = facts.find_module(module);
  return known == nullptr ? not_known(fmt::format("{} has no module '{}'", facts.node, module))
                          : Question(facts, *known, tick).answer();
}

std::uint64_t last_trouble(const Facts& facts, const std::string& module) {
  const ModuleFact* known = facts.find_module(module);
  if (known == nullptr || facts.basic_period_ns <= 0 || facts.tick == 0) {
    return kNone;
  }
  const auto index = static_cast<std::uint32_t>(known - facts.modules.data());
  const std::int64_t limit = known->deadline_ns > 0 ? known->deadline_ns : known->period_ns;
  std::vector<std::uint64_t> ran;
  std::uint64_t last = kNone;
  for (const RunFact& run : facts.runs) {
    if (run.module == index) {
      ran.push_back(run.tick);
      if (run.faulted || (limit > 0 && run.end_ns - run.release_ns > limit)) {
        last = last == kNone ? run.tick : std::max(last, run.tick);
      }
    }
  }
  std::sort(ran.begin(), ran.end());
  const Known ends(facts, index);
  // The tick that has just begun may be under way, and a run within its time limit may still come.
  constexpr std::uint64_t kMaxTicks = 10'000'000;  // beyond this nothing is known, or the number is damaged
  const std::uint64_t oldest =
      std::max({facts.first_tick, facts.schedule_tick, facts.tick - std::min(facts.tick, kMaxTicks)});
  for (std::uint64_t tick = facts.tick - 1; known->operation == "periodic" && tick-- > oldest;) {
    const bool over = facts.release_of(tick) + limit <= facts.now_ns;
    const bool known_to_end = ends.at(tick) && facts.hole_around(index, tick) == nullptr;
    if (over && known_to_end && due(facts, *known, tick) && !std::binary_search(ran.begin(), ran.end(), tick)) {
      return last == kNone ? tick : std::max(last, tick);
    }
  }
  return last;
}

}  // namespace indurop::explain
