// SPDX-License-Identifier: Apache-2.0
#include "history/explain/lateness.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "history/explain/words.h"

namespace indurop::explain {
namespace {

constexpr std::size_t kNeighbours = 40;  // runs a run is compared with
constexpr std::size_t kFew = 3;
constexpr std::uint64_t kLongestMacro = 1'000'000;  // ticks
constexpr int kDeepest = 8;                         // maximum depth of modules waiting for each other

std::int64_t median(std::vector<std::int64_t>& values) {
  if (values.empty()) {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns whether the part is at least half of the whole.
bool most_of(std::int64_t part, std::int64_t whole) {
  return 2 * part >= whole;
}

std::int64_t limit_of(const ModuleFact& module) {
  return module.deadline_ns > 0 ? module.deadline_ns : module.period_ns;
}

bool runs_in(const ModuleFact& module, std::string_view thread) {
  return module.fifo_priority > 0 && thread == fmt::format("irp-band-{}", module.fifo_priority);
}

// Threads of lower priority wait for the module: their ready time without running is no evidence about it.
bool depends_on(const ModuleFact& module, std::string_view thread) {
  return thread.empty() || thread.starts_with("irp-tick") || runs_in(module, thread) ||
         (thread == "irp-events" && module.operation == "sporadic") ||
         (thread.starts_with("irp-band") && module.fifo_priority == 0 && module.operation == "periodic");
}

// Puts `prefix` before the text of the answer.
Answer with_prefix(const std::string& prefix, Answer why) {
  why.text = prefix + why.text;
  return why;
}

}  // namespace

std::string Lateness::figures(const RunFact& run) const {
  return fmt::format("{}: {} was released, began {} later and ended {} after its release", at_tick(facts_, run.tick),
                     name(run.module), short_time(run.start_ns - run.release_ns),
                     short_time(run.end_ns - run.release_ns));
}

// The runs nearest in time, on both sides; those at the same position in the macro period, if there are a few of them.
std::vector<const RunFact*> Lateness::neighbours(const RunFact& run) const {
  std::uint64_t macro = 1;
  for (const ModuleFact& module : facts_.modules) {
    if (module.period_ns > 0 && facts_.basic_period_ns > 0 && macro < kLongestMacro) {
      const std::uint64_t every = facts_.ticks_between_runs(module);
      macro = every < kLongestMacro ? std::lcm(macro, every) : kLongestMacro;
    }
  }
  std::vector<const RunFact*> all;
  std::vector<const RunFact*> same;
  for (const RunFact& other : facts_.runs) {
    if (other.module == run.module && other.tick != run.tick && !other.faulted) {
      all.push_back(&other);
      if (other.tick % macro == run.tick % macro) {
        same.push_back(&other);
      }
    }
  }
  std::vector<const RunFact*>& best = same.size() >= kFew ? same : all;
  const auto distance = [&](const RunFact* other) {
    return other->tick > run.tick ? other->tick - run.tick : run.tick - other->tick;
  };
  std::stable_sort(best.begin(), best.end(),
                   [&](const RunFact* a, const RunFact* b) { return distance(a) < distance(b); });
  best.resize(std::min(best.size(), kNeighbours));
  return best;
}

std::map<Lateness::Key, std::int64_t> Lateness::shares_of(const Timeline& timeline, const RunFact& run) const {
  std::map<Key, std::int64_t> out;
  for (const auto& [module, time] : timeline.shares({run.release_ns, run.start_ns})) {
    out[{module, false}] += time;
  }
  for (const auto& [module, time] : timeline.shares({run.start_ns, run.end_ns})) {
    out[{module, module == run.module}] += time;
  }
  return out;
}

Lateness::Compared Lateness::compare(const RunFact& run) const {
  const Timeline timeline(facts_, facts_.modules[run.module].core);
  std::vector<std::int64_t> responses;
  std::vector<std::map<Key, std::int64_t>> before;
  for (const RunFact* other : neighbours(run)) {
    before.push_back(shares_of(timeline, *other));
    responses.push_back(other->end_ns - other->release_ns);
  }
  Compared out;
  out.others = responses.size();
  out.more_ns = run.end_ns - run.release_ns - median(responses);
  for (const auto& [key, whole] : shares_of(timeline, run)) {
    std::vector<std::int64_t> values;
    for (auto& shares : before) {
      values.push_back(shares[key]);
    }
    out.all.push_back({key.first, key.second, whole - median(values), whole});
  }
  std::stable_sort(out.all.begin(), out.all.end(),
                   [](const Excess& a, const Excess& b) { return a.more_ns > b.more_ns; });
  return out;
}

std::vector<std::string> Lateness::list(const Compared& compared) const {
  std::vector<std::string> lines;
  for (const Excess& one : compared.all) {
    lines.push_back(
        fmt::format("{} had the core for {} of that time{}",
                    one.module == kNoModule ? "nothing of the node"
                    : one.own               ? name(one.module) + " itself"
                                            : "module " + name(one.module),
                    short_time(one.whole_ns),
                    compared.others == 0 ? std::string() : ", usually " + short_time(one.whole_ns - one.more_ns)));
  }
  return lines;
}

Answer Lateness::explain(const RunFact& run, int depth) const {
  const ModuleFact& module = facts_.modules[run.module];
  const Compared compared = compare(run);
  const std::int64_t response = run.end_ns - run.release_ns;
  const std::int64_t limit = limit_of(module);
  const bool too_late = limit > 0 && response > limit;
  const std::int64_t is_noteworthy = limit > 0 ? limit / 20 : 100'000;
  Answer answer;
  if (!too_late && compared.more_ns < is_noteworthy) {
    answer = {Cause::AllIsWell, {}, fmt::format("{} ran and was not late", module.name), {}};
  } else if (compared.others > 0 && compared.more_ns * 10 < response && response - compared.more_ns > limit) {
    answer = {Cause::Schedule,
              {},
              fmt::format("{} always takes about this long to its end: too many modules are due at once", module.name),
              {}};
  } else {
    answer = blame(run, compared, depth);
  }
  std::vector<std::string> lines{figures(run)};
  for (std::string& line : list(compared)) {
    lines.push_back(std::move(line));
  }
  answer.evidence.insert(answer.evidence.begin(), lines.begin(), lines.end());
  return answer;
}

Answer Lateness::blame(const RunFact& run, const Compared& compared, int depth) const {
  if (compared.all.empty() || depth > kDeepest) {
    return not_known("it is not known what ran meanwhile");
  }
  if (const HoleFact* hole = facts_.hole_within(facts_.modules[run.module].core, run.release_ns, run.end_ns)) {
    return not_known(
        fmt::format("{} was late, and the recording lacks runs of {} meanwhile", name(run.module), name(hole->module)));
  }
  const Excess& first = compared.all[0];
  if (!most_of(first.more_ns, compared.more_ns)) {
    return not_known(
        fmt::format("no single cause accounts for it: {} ended {} later than usual, and neither a module nor the "
                    "machine took more than {} above its usual time",
                    name(run.module), short_time(compared.more_ns), short_time(first.more_ns)));
  }
  if (compared.all.size() > 1 && compared.all[1].more_ns * 10 > first.more_ns * 6) {
    const auto called = [&](const Excess& one) {
      return one.module == kNoModule ? std::string("the machine") : name(one.module);
    };
    return not_known(fmt::format("two took longer than usual: {} by {}, {} by {}", called(first),
                                 short_time(first.more_ns), called(compared.all[1]),
                                 short_time(compared.all[1].more_ns)));
  }
  if (first.module == kNoModule) {
    return blame_gap(run, first, depth);
  }
  return first.own ? blame_itself(run, first) : blame_other(run, first, depth);
}

Answer Lateness::blame_itself(const RunFact& run, const Excess& own) const {
  const std::string& self = name(run.module);
  if (!facts_.is_virtual) {
    const Answer kernel =
        machine({run.start_ns, run.end_ns}, facts_.modules[run.module].core, facts_.modules[run.module], own.more_ns);
    if (kernel.cause == Cause::Machine) {
      return with_prefix(fmt::format("the run of {} took {} longer than usual, but not for its own computation: ", self,
                                     short_time(own.more_ns)),
                         kernel);
    }
    if (kernel.cause == Cause::NotKnown) {
      return with_prefix(
          fmt::format("the run of {} took {} longer than usual by the clock. ", self, short_time(own.more_ns)), kernel);
    }
  }
  return {Cause::OwnTime,
          self,
          fmt::format("{} took longer itself: {}, usually {}", self, short_time(own.whole_ns),
                      short_time(own.whole_ns - own.more_ns)),
          {}};
}

// Another module had the core longer than usual in this time: because it took longer, or because it came later.
Answer Lateness::blame_other(const RunFact& run, const Excess& other, int depth) const {
  const RunFact* its = nullptr;
  for (const RunFact& one : facts_.runs) {
    const bool overlaps =
        one.module == other.module && &one != &run && one.start_ns < run.end_ns && one.end_ns > run.release_ns;
    if (overlaps && (its == nullptr || one.end_ns - one.start_ns > its->end_ns - its->start_ns)) {
      its = &one;
    }
  }
  const ModuleFact& module = facts_.modules[other.module];
  const std::string prefix = fmt::format("{} had the core for {} before {} could end", module.name,
                                         short_time(other.whole_ns), name(run.module));
  if (its == nullptr) {
    return not_known("its runs are not known");
  }
  const Compared compared = compare(*its);
  const auto own = std::find_if(compared.all.begin(), compared.all.end(), [](const Excess& one) { return one.own; });
  const std::int64_t longer = own == compared.all.end() || compared.others == 0 ? 0 : own->more_ns;
  if (module.operation == "sporadic" && !most_of(longer, other.more_ns)) {
    return {Cause::OwnTime, module.name, prefix + ": its event came, and it has the higher priority", {}};
  }
  if (most_of(longer, other.more_ns)) {
    return with_prefix(prefix + ". ", blame_itself(*its, *own));
  }
  if (most_of(compared.more_ns, other.more_ns) && compared.others > 0) {
    return with_prefix(prefix + ", because it was late itself. ", blame(*its, compared, depth + 1));
  }
  return not_known(fmt::format("{}, longer than usual, although it neither took longer itself nor was late", prefix));
}

// Also true if a module that precedes it in the same thread waits for the other one.
bool Lateness::waits_for(const ModuleFact& module, const std::string& other) const {
  return std::any_of(facts_.modules.begin(), facts_.modules.end(), [&](const ModuleFact& one) {
    const bool same_thread =
        one.core == module.core && one.period_ns == module.period_ns && one.priority <= module.priority;
    return same_thread && std::find(one.after.begin(), one.after.end(), other) != one.after.end();
  });
}

// Before it began no module of the node had its core: it waited for another core, or was prevented from running.
Answer Lateness::blame_gap(const RunFact& run, const Excess& gap, int depth) const {
  const ModuleFact& module = facts_.modules[run.module];
  const RunFact* last = nullptr;
  for (const RunFact& one : facts_.runs) {
    if (facts_.modules[one.module].core != module.core && waits_for(module, name(one.module)) && one.tick <= run.tick &&
        one.end_ns > run.release_ns && one.end_ns <= run.start_ns && (last == nullptr || one.end_ns > last->end_ns)) {
      last = &one;
    }
  }
  if (last != nullptr && most_of(last->end_ns - std::max(last->release_ns, run.release_ns), gap.more_ns)) {
    return with_prefix(
        fmt::format("{} waited for {}, which ended on core {} only {} after the release. ", module.name,
                    name(last->module), facts_.modules[last->module].core, short_time(last->end_ns - run.release_ns)),
        blame(*last, compare(*last), depth + 1));
  }
  for (const ModuleFact& other : facts_.modules) {
    if (other.core != module.core && waits_for(module, other.name)) {
      const Answer kernel = machine({run.release_ns, run.start_ns}, other.core, other, gap.more_ns);
      if (kernel.cause == Cause::Machine) {
        return with_prefix(
            fmt::format("{} waits for {} of core {}, which did not come: ", module.name, other.name, other.core),
            kernel);
      }
    }
  }
  Answer kernel = machine({run.release_ns, run.end_ns}, module.core, module, gap.more_ns);
  if (kernel.cause == Cause::AllIsWell) {
    kernel.cause = facts_.is_virtual ? Cause::Machine : Cause::NotKnown;
  }
  return with_prefix(fmt::format("for {} longer than usual, no thread of the node ran on core {}: ",
                                 short_time(gap.more_ns), module.core),
                     kernel);
}

// The time that threads on the core were ready without running. The part taken by modules in other threads of the node
// is not attributed to other programs; a tick thread with real-time priority waits for none of them.
Lateness::Waited Lateness::waited(Span span, std::int32_t core, const ModuleFact& module) const {
  const Timeline timeline(facts_, core);
  Waited out;
  for (const KernelFact& one : facts_.kernel) {
    if (one.from_ns >= span.to_ns || one.to_ns <= span.from_ns || (one.core != core && core >= 0 && one.core >= 0) ||
        !depends_on(module, one.thread)) {
      continue;
    }
    std::int64_t own = 0;
    for (const auto& [other, time] : timeline.shares({one.from_ns, one.to_ns})) {
      own += other == kNoModule || runs_in(facts_.modules[other], one.thread) ? 0 : time;
    }
    const bool above_all = facts_.realtime && one.thread.starts_with("irp-tick");
    out.whole_ns = std::max(out.whole_ns, one.waited_ns);
    out.for_others_ns = std::max(out.for_others_ns, one.waited_ns - (above_all ? 0 : own));
    out.stolen_ns += one.stolen_ns;
    out.pages += one.major_faults;
  }
  return out;
}

Answer Lateness::machine(Span span, std::int32_t core, const ModuleFact& module, std::int64_t so_much_ns) const {
  if (facts_.is_virtual) {
    return {Cause::AllIsWell, {}, "virtual time knows no other programs", {}};
  }
  if (facts_.kernel_from_ns > span.from_ns || span.to_ns > facts_.kernel_to_ns) {
    return not_known("the kernel's counters of that time were not kept");
  }
  const Waited counted = waited(span, core, module);
  const std::int64_t enough = so_much_ns / 2;
  Answer answer{Cause::Machine, {}, {}, {}};
  if (counted.stolen_ns >= enough) {
    answer.culprit = "host";
    answer.text = fmt::format("the hypervisor took the processor away for {}", short_time(counted.stolen_ns));
  } else if (counted.pages > 0) {
    answer.culprit = "page fault";
    answer.text = fmt::format("memory had to be read from the disk ({} pages)", counted.pages);
  } else if (counted.for_others_ns >= enough) {
    answer.culprit = "other programs";
    answer.text =
        fmt::format("its thread was ready for {} while other programs had the core", short_time(counted.for_others_ns));
  } else if (counted.whole_ns >= enough) {
    answer =
        not_known(fmt::format("its thread was ready for {} without running, and modules of the node or other "
                              "programs may have had the core",
                              short_time(counted.whole_ns)));
  } else {
    answer = {Cause::AllIsWell, {}, "the kernel counted nothing unusual", {}};
  }
  answer.evidence.push_back(fmt::format("kernel: ready but not running for {}, stolen {}, pages from the disk {}",
                                        short_time(counted.whole_ns), short_time(counted.stolen_ns), counted.pages));
  return answer;
}

}  // namespace indurop::explain
