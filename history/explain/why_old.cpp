// SPDX-License-Identifier: Apache-2.0
// Explains why a value is old, and who changed a value last.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "history/explain/questions.h"
#include "history/explain/words.h"

namespace indurop::explain {
namespace {

// Splits "control@sensor" into control and sensor.
std::pair<std::string, std::string> module_and_board(const std::string& writer) {
  const auto at = writer.find('@');
  return at == std::string::npos ? std::pair(writer, std::string())
                                 : std::pair(writer.substr(0, at), writer.substr(at + 1));
}

const ChangeFact* last_change(const Facts& facts, const std::string& variable, std::int64_t at_ns) {
  const ChangeFact* last = nullptr;
  for (const ChangeFact& change : facts.changes) {
    if (change.variable == variable && change.time_ns <= at_ns &&
        (last == nullptr || change.time_ns >= last->time_ns)) {
      last = &change;
    }
  }
  return last;
}

const RunFact* last_run(const Facts& facts, const std::string& module, std::int64_t at_ns) {
  const ModuleFact* known = facts.find_module(module);
  const RunFact* last = nullptr;
  for (const RunFact& run : facts.runs) {
    if (known != nullptr && &facts.modules[run.module] == known && run.end_ns <= at_ns &&
        (last == nullptr || run.end_ns > last->end_ns)) {
      last = &run;
    }
  }
  return last;
}

// Returns the hole in a writer's runs between two times of the recording.
const HoleFact* hole_after(const Facts& facts, const std::string& variable, std::int64_t from_ns, std::int64_t to_ns) {
  const VariableFact* const known = facts.find_variable(variable);
  const auto writes = [&](const std::string& module) {
    return std::any_of(known->writers.begin(), known->writers.end(), [&](const std::string& writer) {
      const auto [name, board] = module_and_board(writer);
      return name == module && (board.empty() || board == facts.board);
    });
  };
  for (const HoleFact& hole : facts.holes) {
    if (known != nullptr && hole.to_ns > from_ns && hole.from_ns < to_ns && writes(facts.modules[hole.module].name)) {
      return &hole;
    }
  }
  return nullptr;
}

bool names_of(const std::string& part, const std::string& variable) {
  return part == variable || part.starts_with(variable + ".") || part.starts_with(variable + "[");
}

const OrderFact* last_order(const Facts& facts, const std::string& variable, std::int64_t at_ns) {
  const OrderFact* last = nullptr;
  for (const OrderFact& order : facts.orders) {
    const bool matches = order.action == "set" || order.action == "force" || order.action == "unforce";
    const bool all = order.action == "unforce" && order.what == "*";
    if (matches && (all || names_of(order.what, variable)) && order.node_ns <= at_ns &&
        (last == nullptr || order.node_ns >= last->node_ns)) {
      last = &order;
    }
  }
  return last;
}

// One variable on the board where it is written.
class Old {
 public:
  Old(const Facts& facts, const VariableFact& variable, std::int64_t at_ns)
      : facts_(facts), variable_(variable), at_ns_(at_ns) {}

  Answer answer() const {
    if (variable_.forced_until_ns > at_ns_ || was_forced()) {
      return forced();
    }
    if (const DeviceFact* device = bad_device(); device != nullptr) {
      return of_device(*device);
    }
    if (variable_.writers.empty()) {
      return {Cause::Nobody, {}, fmt::format("no module writes {}", variable_.name), {}};
    }
    const std::string writer = here();
    if (writer.empty()) {
      return not_known(fmt::format("{} is written by {}, about which nothing is known here", variable_.name,
                                   fmt::join(variable_.writers, ", ")));
    }
    Answer answer = of_writer(writer);
    if (const ChangeFact* change = last_change(facts_, variable_.name, at_ns_); change != nullptr) {
      answer.evidence.push_back(fmt::format("{} changed last in {}, by {}", variable_.name,
                                            at_tick(facts_, change->tick),
                                            change->module.empty() ? "no module of the schedule" : change->module));
    }
    return answer;
  }

 private:
  [[nodiscard]] const DeviceFact::Quality* quality_of(const DeviceFact& device) const {
    const DeviceFact::Quality* last = nullptr;
    for (const DeviceFact::Quality& one : device.qualities) {
      last = one.time_ns <= at_ns_ ? &one : last;
    }
    return last;
  }

  // Returns a device that exchanges the variable or a part of it, and whose quality is not good; null: none.
  [[nodiscard]] const DeviceFact* bad_device() const {
    const auto found = std::find_if(facts_.devices.begin(), facts_.devices.end(), [this](const DeviceFact& device) {
      const DeviceFact::Quality* const quality = quality_of(device);
      return quality != nullptr && quality->number != DeviceFact::kGood &&
             std::any_of(device.variables.begin(), device.variables.end(),
                         [this](const std::string& part) { return names_of(part, variable_.name); });
    });
    return found == facts_.devices.end() ? nullptr : &*found;
  }

  [[nodiscard]] Answer of_device(const DeviceFact& device) const {
    const DeviceFact::Quality& quality = *quality_of(device);
    return {
        Cause::Device,
        device.name,
        fmt::format("{} is exchanged with device {} ({}): {}", variable_.name, device.name, device.place,
                    quality_text(quality.number)),
        {fmt::format("{} is {}{}", device.quality, quality.number,
                     quality.time_ns == DeviceFact::kSinceBefore ? "" : " since " + when(facts_, quality.time_ns))}};
  }

  // Returns whether it was forced at a time in the past.
  [[nodiscard]] bool was_forced() const {
    const OrderFact* order = last_order(facts_, variable_.name, at_ns_);
    return order != nullptr && order->action == "force" && order->until_ns > at_ns_;
  }

  [[nodiscard]] Answer forced() const {
    const OrderFact* order = last_order(facts_, variable_.name, at_ns_);
    if (order != nullptr && order->action == "force") {
      return {Cause::Force,
              order->who,
              fmt::format("{} is held at {} by {}", order->what, order->value, who(*order)),
              {fmt::format("{}: force {}={}", when(facts_, order->node_ns), order->what, order->value)}};
    }
    return {Cause::Force, {}, fmt::format("{} is forced; by whom was not noted", variable_.name), {}};
  }

  // Returns the only writer that is a module of this board.
  [[nodiscard]] std::string here() const {
    std::string found;
    for (const std::string& writer : variable_.writers) {
      const auto [module, board] = module_and_board(writer);
      if ((board.empty() || board == facts_.board) && facts_.find_module(module) != nullptr) {
        found = module;
      }
    }
    return found;
  }

  [[nodiscard]] Answer of_writer(const std::string& writer) const {
    const ModuleFact& module = *facts_.find_module(writer);
    const RunFact* ran = last_run(facts_, writer, at_ns_);
    if (module.operation != "periodic") {
      return {Cause::Unchanged, writer,
              fmt::format("{} is written by {}, which runs {}", variable_.name, writer,
                          module.operation == "sporadic" ? "when its event comes" : "in the background"),
              ran == nullptr ? std::vector<std::string>()
                             : std::vector{fmt::format("its last run was in {}", at_tick(facts_, ran->tick))}};
    }
    // The last tick whose run could be over by then.
    const auto every = std::max<std::int64_t>(module.period_ns, 1);
    const std::int64_t since = at_ns_ - facts_.epoch_ns - module.offset_ns - every;
    if (since < 0) {
      return not_known("the schedule had hardly begun");
    }
    std::uint64_t due = facts_.ticks_in(since / every * every + module.offset_ns);
    // The facts often end with the node: then its last run counts, not one that would have followed.
    const bool at_the_end = at_ns_ <= facts_.release_of(facts_.tick) + 2 * every;
    if (at_the_end && facts_.tick > 0 && due >= facts_.tick) {
      const std::uint64_t step = facts_.ticks_between_runs(module);
      const std::uint64_t first = facts_.ticks_in(module.offset_ns);
      due = facts_.tick > first ? first + (facts_.tick - 1 - first) / step * step : first;
    }
    // The output of a process is known before its node has recorded that the run is over.
    const ChangeFact* change = last_change(facts_, variable_.name, at_ns_);
    const bool wrote = change != nullptr && change->module == writer;
    const bool newer = wrote && (ran == nullptr || change->time_ns > ran->end_ns);
    if (newer ? change->tick >= due : ran != nullptr && ran->tick >= due && !ran->faulted) {
      const std::string when =
          fmt::format("{} ran last in {}", writer, at_tick(facts_, newer ? change->tick : ran->tick));
      if (newer || (wrote && change->time_ns >= ran->start_ns)) {
        return {Cause::AllIsWell, {}, fmt::format("{} changed {} in its last run", writer, variable_.name), {when}};
      }
      if (!variable_.recorded) {
        return not_known(fmt::format("the values of {} are not recorded; {}", variable_.name, when));
      }
      return {Cause::Unchanged, writer, fmt::format("{} runs and leaves {} as it is", writer, variable_.name), {when}};
    }
    const std::uint64_t asked =
        ran == nullptr || ran->faulted ? due : std::min<std::uint64_t>(due, next_due(*ran, module));
    Answer why = why_late(facts_, writer, asked);
    why.text = fmt::format("{} is written by {}, which did not run in time. {}", variable_.name, writer, why.text);
    return why;
  }

  [[nodiscard]] std::uint64_t next_due(const RunFact& run, const ModuleFact& module) const {
    return run.tick + facts_.ticks_between_runs(module);
  }

  const Facts& facts_;
  const VariableFact& variable_;
  std::int64_t at_ns_;
};

}  // namespace

Answer why_old(std::span<const Facts> plant, std::size_t asked, const std::string& variable, std::int64_t at_ns) {
  const Facts& facts = plant[asked];
  const VariableFact* known = facts.find_variable(variable);
  if (known == nullptr) {
    return not_known(fmt::format("{} has no variable '{}'", facts.node, variable));
  }
  const bool here = known->owner.empty() || known->owner == facts.board;
  if (here || known->forced_until_ns > at_ns) {
    return Old(facts, *known, at_ns).answer();
  }
  const BoardFact* peer = facts.find_peer(known->owner);
  if (peer == nullptr || peer->state != "alive") {
    Answer answer = why_gone(plant, asked, known->owner);
    answer.text = fmt::format("{} comes from board {}. {}", variable, known->owner, answer.text);
    return answer;
  }
  const Facts* its = find_board(plant, known->owner);
  const VariableFact* there = its == nullptr ? nullptr : its->find_variable(variable);
  if (there == nullptr) {
    return not_known(
        fmt::format("{} comes from board {}, which is connected; the runs of its modules are known only there: give "
                    "its recording too, or ask on its host",
                    variable, known->owner));
  }
  const std::int64_t its_now = on_clock_of(*its, facts, at_ns);
  const ChangeFact* change = last_change(*its, variable, its_now);
  if (known->every_ns > 0 && change != nullptr && its_now - change->time_ns < known->every_ns) {
    return {Cause::Rate,
            known->owner,
            fmt::format("{} is sent every {} at most", variable, short_time(known->every_ns)),
            {fmt::format("board {} changed it last in {} there", known->owner, at_tick(*its, change->tick))}};
  }
  Answer answer = Old(*its, *there, its_now).answer();
  answer.text = fmt::format("{} comes from board {}, which is connected. {}", variable, known->owner, answer.text);
  return answer;
}

Answer who_changed(const Facts& facts, const std::string& variable, std::int64_t at_ns) {
  const OrderFact* order = last_order(facts, variable, at_ns);
  const ChangeFact* change = last_change(facts, variable, at_ns);
  if (order == nullptr && change == nullptr) {
    return not_known(fmt::format("no writer of {} is known since tick {}", variable, facts.first_tick));
  }
  std::vector<std::string> evidence;
  if (order != nullptr) {
    evidence.push_back(fmt::format("{}: {} {}{}{} by {}", when(facts, order->node_ns), order->action, order->what,
                                   order->value.empty() ? "" : "=", order->value, who(*order)));
  }
  if (change != nullptr) {
    evidence.push_back(fmt::format("{}: new value by {}", at_tick(facts, change->tick),
                                   change->module.empty() ? "a writer outside the schedule" : change->module));
  }
  const std::int64_t since =
      std::max(order != nullptr ? order->node_ns : INT64_MIN, change != nullptr ? change->time_ns : INT64_MIN);
  if (const HoleFact* const hole = hole_after(facts, variable, since, at_ns)) {
    Answer answer =
        not_known(fmt::format("after that the recording lacks {} runs of {}, which writes it, up to tick {}",
                              hole->runs, facts.modules[hole->module].name, hole->before_tick));
    answer.evidence = evidence;
    return answer;
  }
  const bool by_order = order != nullptr && (change == nullptr || change->module.empty() ||
                                             order->node_ns >= change->time_ns || order->action == "force");
  if (by_order) {
    const Cause cause = order->action == "force" ? Cause::Force : Cause::Set;
    return {cause, order->who,
            fmt::format("{} {} {} last{}", who(*order),
                        order->action == "force" ? "forced"
                        : order->action == "set" ? "set"
                                                 : "released",
                        order->what, order->value.empty() ? "" : ", to " + order->value),
            evidence};
  }
  if (change->module.empty()) {
    Answer answer = not_known("no module of the schedule wrote it, and no command was noted");
    answer.evidence = evidence;
    return answer;
  }
  return {Cause::Module, change->module,
          fmt::format("{} wrote {} last, in {}", change->module, variable, at_tick(facts, change->tick)), evidence};
}

}  // namespace indurop::explain
