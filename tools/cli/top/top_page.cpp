// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/top/top_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/rt/clock.h"
#include "core/rt/relaxed.h"
#include "history/alarms/alarm_journal.h"
#include "history/alarms/alarm_list.h"
#include "history/alarms/alarm_watch.h"
#include "store/operate/journal.h"
#include "store/vars/store.h"
#include "tools/cli/command/screen.h"
#include "tools/client/robot/open_questions.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using rt::kRelaxed;
constexpr std::size_t kEvents = 5;
constexpr std::size_t kMessages = 2;  // maximum messages among these: a module that prints all the time hides nothing
constexpr std::size_t kTroubles = 3;
constexpr const char* kKeys = "q Quit  n Node  s Sort  Space Pause  Up/Down Scroll";

TopSample::Module sample_of(const scheduler::ModuleRecord& record) {
  const auto exec = scheduler::summarize(record.exec);
  const auto jitter = scheduler::summarize(record.jitter);
  const auto state = record.state.load(kRelaxed);
  TopSample::Module out;
  out.name = printable(fixed_text(record.name));
  out.state = to_text(state);
  out.well = state == scheduler::ModuleState::Running || state == scheduler::ModuleState::Exited;
  out.runs = record.runs.load(kRelaxed);
  out.overruns = record.overruns.load(kRelaxed);
  out.exec_sum_ns = record.exec.sum.load(kRelaxed);
  out.mean_ns = exec.mean;
  out.max_ns = exec.max;
  out.jitter_p99_ns = jitter.p99;
  const auto kind = static_cast<scheduler::FaultKind>(record.fault_kind.load(std::memory_order_acquire));
  out.fault = kind == scheduler::FaultKind::None ? std::string() : printable(fixed_text(record.last_fault));
  out.load = record.period_ns > 0 ? static_cast<double>(exec.mean) / static_cast<double>(record.period_ns) : 0;
  return out;
}

void set_loads(TopSample& sample, const TopSample& before) {
  const auto time = static_cast<double>(sample.at_ns - before.at_ns);
  for (TopSample::Module& module : sample.modules) {
    const auto same = std::find_if(before.modules.begin(), before.modules.end(),
                                   [&](const TopSample::Module& one) { return one.name == module.name; });
    if (same != before.modules.end() && time > 0 && module.exec_sum_ns >= same->exec_sum_ns) {
      module.load = static_cast<double>(module.exec_sum_ns - same->exec_sum_ns) / time;
    }
  }
}

void add_troubles(TopSample& sample, const std::optional<MirrorView>& mirror) {
  if (!sample.report.alive) {
    sample.troubles.push_back(fmt::format("the node is {}{}", sample.report.state,
                                          sample.report.stop_reason.empty() ? "" : ": " + sample.report.stop_reason));
  }
  for (const TopSample::Module& module : sample.modules) {
    if (!module.fault.empty()) {
      sample.troubles.push_back(fmt::format("{}: {}", module.name, module.fault));
    } else if (!module.well) {
      sample.troubles.push_back(fmt::format("{} is {}", module.name, module.state));
    }
  }
  if (mirror && !mirror->problem.empty()) {
    sample.troubles.push_back(printable(mirror->problem));
  }
  for (const PeerView& peer : mirror ? mirror->peers : std::vector<PeerView>()) {
    if (!peer.problem.empty()) {
      sample.troubles.push_back(printable(fmt::format("board {}: {}", peer.name, peer.problem)));
    }
  }
}

std::string event_of(const RunView& run, const OverrunSample& one) {
  std::string text = fmt::format("tick {}: {} ", one.tick, run.module_name(one.module));
  text += one.started ? fmt::format("ran {} and was not done", human_ns(one.own_ns)) : "still waited for its turn";
  return one.previous >= 0
             ? fmt::format("{}, behind {} with {}", text, run.module_name(one.previous), human_ns(one.previous_ns))
             : text;
}

std::string order_of(const scheduler::RunBlock& block, const operate::Order& order) {
  const std::int64_t since = std::max<std::int64_t>(order.node_ns - block.epoch_ns, 0);
  std::string text = fmt::format("tick {}: {} {}{}", since / std::max<std::int64_t>(block.basic_period_ns, 1),
                                 order.action, order.what, order.value.empty() ? "" : " = " + order.value);
  text += fmt::format(", by {}{}", order.who, order.from.empty() ? "" : " on " + order.from);
  return printable(order.reason.empty() ? text : fmt::format("{}: {}", text, order.reason));
}

std::string message_of(const RunView& run, const MessageSample& one) {
  const scheduler::RunBlock& block = run.block();
  const std::int64_t since = std::max<std::int64_t>(one.time_ns - block.epoch_ns, 0);
  return printable(
      fmt::format("tick {}: {}: {}", since / std::max<std::int64_t>(block.basic_period_ns, 1), one.who, one.text));
}

// Returns overruns, external commands in this run and output of modules, oldest first.
std::vector<TopEvent> newest_events(const std::string& node, const RunView& run) {
  std::vector<TopEvent> all;
  const scheduler::RunBlock& block = run.block();
  for (const OverrunSample& one : run.overrun_log(kEvents)) {
    all.push_back({block.epoch_ns + static_cast<std::int64_t>(one.tick) * block.basic_period_ns, event_of(run, one)});
  }
  const auto orders = operate::read_orders(node, block.started_wall_ns);
  for (std::size_t i = orders.size() - std::min(orders.size(), kEvents); i < orders.size(); ++i) {
    all.push_back({orders[i].node_ns, order_of(block, orders[i])});
  }
  for (const MessageSample& one : run.messages(kMessages)) {
    all.push_back({one.time_ns, message_of(run, one)});
  }
  std::stable_sort(all.begin(), all.end(), [](const TopEvent& a, const TopEvent& b) { return a.time_ns < b.time_ns; });
  all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(std::min(all.size(), kEvents)));
  return all;
}

bool comes_before(const TopSample::Module& a, const TopSample::Module& b, TopOrder order) {
  switch (order) {
    case TopOrder::Load:
      return a.load > b.load;
    case TopOrder::Name:
      return a.name < b.name;
    case TopOrder::Overruns:
      return a.overruns > b.overruns;
    case TopOrder::Jitter:
      return a.jitter_p99_ns > b.jitter_p99_ns;
  }
  return false;
}

std::string row_of(const TopSample::Module& module, int name_width) {
  const bool ran = module.mean_ns > 0 || module.max_ns > 0;
  return fmt::format("{:<{}} {:<9} {:>10} {:>6} {:>5.1f} {:>8} {:>8} {:>8}",
                     module.name.substr(0, static_cast<std::size_t>(name_width)), name_width, module.state, module.runs,
                     module.overruns, module.load * 100, ran ? human_ns(module.mean_ns) : "-",
                     ran ? human_ns(module.max_ns) : "-",
                     module.jitter_p99_ns > 0 ? human_ns(module.jitter_p99_ns) : "-");
}

std::string heading(const TopSample& sample, const TopLook& look) {
  const auto at = std::find(look.nodes.begin(), look.nodes.end(), sample.report.node);
  const std::string which = look.nodes.size() > 1 && at != look.nodes.end()
                                ? fmt::format(" ({} of {})", at - look.nodes.begin() + 1, look.nodes.size())
                                : std::string();
  return fmt::format("node {}{}  {}{}{}", sample.report.node, which, sample.report.state,
                     sample.report.uptime_ns > 0 ? " for " + human_age(sample.report.uptime_ns) : "",
                     look.paused ? "  PAUSED" : "");
}

void finish(std::vector<TopLine>& lines, int columns, int rows) {
  const auto room = static_cast<std::size_t>(std::max(rows, 1));
  lines.resize(std::max<std::size_t>(room, 1) - 1);
  lines.push_back({kKeys, Style::Accent, false});
  for (TopLine& line : lines) {
    line.text = cut_to_width(line.text, static_cast<std::size_t>(std::max(columns, 1)));
  }
}

}  // namespace

TopOrder next_order(TopOrder order) noexcept {
  return order == TopOrder::Jitter ? TopOrder::Load : static_cast<TopOrder>(static_cast<int>(order) + 1);
}

const char* name_of(TopOrder order) noexcept {
  switch (order) {
    case TopOrder::Load:
      return "load";
    case TopOrder::Name:
      return "name";
    case TopOrder::Overruns:
      return "overruns";
    case TopOrder::Jitter:
      return "jitter";
  }
  return "";
}

TopSample take_sample(const std::string& node, const RunView& run, const TopSample* before) {
  TopSample sample;
  sample.report = report_of(node, run);
  sample.at_ns = rt::now_ns();
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    sample.modules.push_back(sample_of(run.module(i)));
  }
  if (before != nullptr && before->report.pid == sample.report.pid) {
    set_loads(sample, *before);
  }
  sample.events = newest_events(node, run);
  const auto mirror = view_mirror(node);
  for (const auto& variable : mirror ? mirror->variables : std::vector<mirror::MirroredVariable>()) {
    sample.stale += variable.valid ? 0 : 1;
  }
  if (const auto store = vars::Store::attach(node, vars::Mode::ReadOnly)) {
    sample.forces = store->forces().size();
    for (const RobotQuestion& one : open_questions(*store)) {
      sample.questions.push_back(
          printable(fmt::format("{} asks (question {}): {} {}", one.space, one.number, one.text, answers_text(one))));
    }
  }
  alarms::AlarmJournal alarms(node);
  alarms.refresh();
  sample.alarms = alarms.book().counts();
  for (const alarms::ListedAlarm& one : alarms::list_alarms({}, alarms.book(), false)) {
    const bool said = one.name.starts_with(alarms::module_alarm(""));  // listed with the modules
    if (one.record.state != alarms::AlarmState::Shelved && !said) {
      sample.troubles.push_back(printable(
          fmt::format("{} alarm, {}: {}", schema::word_of(one.priority), word_of(one.record.state), one.text)));
    }
  }
  add_troubles(sample, mirror);
  return sample;
}

std::vector<TopLine> top_page(const TopSample& sample, const TopLook& look, int columns, int rows) {
  const NodeReport& report = sample.report;
  double load = 0;
  for (const TopSample::Module& module : sample.modules) {
    load += module.load;
  }
  const auto if_any = [](std::uint64_t count, Style style) { return count > 0 ? style : Style::None; };
  const std::size_t alarms = sample.alarms.active + sample.alarms.unacknowledged;
  std::vector<TopLine> lines;
  lines.push_back({heading(sample, look), report.alive ? Style::Good : Style::Bad, false});
  lines.push_back({fmt::format("tick {}  lost {}  load {:.1f} %  late {}, 99 % {}, max {}", report.ticks,
                               report.lost_ticks, load * 100, human_ns(report.lateness.p50),
                               human_ns(report.lateness.p99), human_ns(report.lateness.max)),
                   if_any(report.lost_ticks, Style::Warn), false});
  lines.push_back({fmt::format("modules {}  overruns {}  faults {}  forced {}  stale {}  alarms {}", report.modules,
                               report.overruns, report.faults, sample.forces, sample.stale, alarms),
                   if_any(report.faults + report.overruns + sample.forces + sample.stale + alarms, Style::Warn),
                   false});
  for (const std::string& question : sample.questions) {
    lines.push_back({question, Style::Accent, false});
  }
  for (std::size_t i = 0; i < sample.troubles.size() && i < kTroubles; ++i) {
    lines.push_back({sample.troubles[i], Style::Bad, false});
  }
  constexpr int kOtherColumns = 62;
  const int name_width = std::clamp(columns - kOtherColumns, 10, 40);
  lines.push_back({fmt::format("{:<{}} {:<9} {:>10} {:>6} {:>5} {:>8} {:>8} {:>8}", "MODULE", name_width, "STATE",
                               "RUNS", "OVERR", "LOAD%", "MEAN", "MAX", "JIT 99%"),
                   Style::None, true});
  std::vector<TopSample::Module> modules = sample.modules;
  std::stable_sort(modules.begin(), modules.end(),
                   [&](const auto& a, const auto& b) { return comes_before(a, b, look.order); });
  const std::size_t events = sample.events.empty() ? 0 : sample.events.size() + 1;
  const std::size_t used = lines.size() + 1 + events;
  const std::size_t room = std::max<std::size_t>(
      rows > 0 && static_cast<std::size_t>(rows) > used ? static_cast<std::size_t>(rows) - used : 1, 1);
  const std::size_t first = std::min(look.first, modules.size() > room ? modules.size() - room : 0);
  for (std::size_t i = first; i < modules.size() && i < first + room; ++i) {
    const TopSample::Module& one = modules[i];
    lines.push_back({row_of(one, name_width),
                     !one.well || !one.fault.empty() ? Style::Bad : if_any(one.overruns, Style::Warn), false});
  }
  if (events > 0) {
    lines.push_back({fmt::format("LOG  (sorted by {})", name_of(look.order)), Style::None, true});
    for (const TopEvent& event : sample.events) {
      lines.push_back({event.text, Style::Dim, false});
    }
  }
  finish(lines, columns, rows);
  return lines;
}

std::vector<TopLine> top_nothing(const std::string& why, int columns, int rows) {
  std::vector<TopLine> lines{{"indurop top", Style::Bold, false}, {why, Style::Bad, false}};
  finish(lines, columns, rows);
  return lines;
}

}  // namespace indurop::tools
