// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/schedule_change.h"

#include <algorithm>
#include <utility>

#include "core/base/duration.h"
#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "node/exchange/module_exchange.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Engine;
using scheduler::ModuleCommand;
using scheduler::ModuleType;

constexpr std::size_t kCheckStack = std::size_t{8} * 1024 * 1024;
constexpr std::int64_t kLongestWaitNs = 5 * rt::kNanosPerSecond;  // for a moment without a run in progress
constexpr int kProposals = 10;                                    // each for a later macro period
constexpr std::chrono::milliseconds kCheckPoll{1};

// The configuration of the schedule that runs, as it was after its check.
config::Config config_of_schedule(const config::Config& running, const scheduler::RunBlock& run) {
  config::Config config = running;
  std::vector<config::Module> modules;
  for (std::uint32_t i = 0; i < running.modules.size(); ++i) {
    if (!run.modules()[i].ended) {
      modules.push_back(running.modules[i]);
    }
  }
  config.modules = std::move(modules);
  return config;
}

// Real-time processes have obtained theirs on their own.
void follow_priorities(const scheduler::RunBlock& run) {
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    const scheduler::ModuleRecord& record = run.modules()[i];
    const std::int32_t pid = record.pid.load();
    if (record.type == ModuleType::Process && record.fifo_priority > 0 && pid > 0 && !record.ended) {
      (void)rt::set_fifo_of(pid, record.fifo_priority);
    }
  }
}

// Indices in the run block.
std::vector<std::uint32_t> added_by(const SchedulePlan& plan) {
  std::vector<std::uint32_t> added;
  for (const std::uint32_t place : plan.added) {
    added.push_back(plan.indices[place]);
  }
  return added;
}

std::string summary_of(const SchedulePlan& plan) {
  std::string text;
  using Kind = ModuleFate::Kind;
  for (const Kind kind : {Kind::Kept, Kind::Rescheduled, Kind::Added, Kind::Ended}) {
    const auto number =
        std::count_if(plan.modules.begin(), plan.modules.end(), [kind](const auto& one) { return one.kind == kind; });
    if (number > 0) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, to_text(kind));
    }
  }
  return "modules: " + text;
}

}  // namespace

void ScheduleChange::poll(rt::MonoTime now, const std::string& others) {
  if (scheduler::waiting_command(record(0)) == ModuleCommand::Schedule && (step_ == Step::Idle || held_.on)) {
    accept(others);
  }
  while (parts_.options.simulation.on && step_ == Step::Checking && !is_checked_.load()) {
    rt::sleep_until(rt::MonoClock::now() + kCheckPoll);  // virtual time does not pass
  }
  switch (step_) {
    case Step::Checking:
      return is_checked_.load(std::memory_order_acquire) ? checked() : void();
    case Step::Loading:
      return arrivals_.is_loaded() && !is_given_up() ? loaded() : void();
    case Step::Starting:
      return start(now, others);
    case Step::Building:
      return parts_.engine.follow_change() == Engine::Change::Prepared && !is_given_up() ? begin_waiting() : void();
    case Step::Waiting:
    case Step::Leaving:
      return follow();
    case Step::Idle:
    case Step::Ready:
      return;
  }
}

void ScheduleChange::accept(const std::string& others) {
  const auto request = operate::take_schedule_request(parts_.options.node);
  if (!parts_.options.board.empty()) {
    respond({}, CommandResult::Refused, "it is a board of a plant: `indurop deploy` takes its manifest to all boards");
    return;
  }
  report_ = {};
  if (!request) {
    answer(CommandResult::Refused, "the request cannot be read; repeat the command");
  } else if (!others.empty()) {
    answer(CommandResult::Refused, others + "; repeat the command when that is over");
  } else if (request->back && !previous_) {
    answer(CommandResult::Refused, "there was no other schedule: name a configuration, `indurop reload --config FILE`");
  } else {
    check(*request);
  }
}

void ScheduleChange::check(const operate::ScheduleRequest& request) {
  request_ = request;
  is_checked_.store(false);
  step_ = Step::Checking;
  auto thread = rt::Thread::start({"irp-schedule", 0, -1, kCheckStack}, [this] {
    const bool from_memory = request_.back && !held_.on;
    next_ = from_memory ? recheck(parts_.options, *previous_) : recheck(parts_.options, request_.config);
    is_checked_.store(true, std::memory_order_release);
  });
  if (!thread) {
    return fail("no thread could be started to check the configuration");
  }
  thread_ = std::move(thread).value();
}

void ScheduleChange::checked() {
  thread_.join();
  if (is_given_up()) {
    return;
  }
  std::string error = "the configuration has errors";
  for (const base::Diagnostic& diagnostic : next_.diagnostics) {
    if (diagnostic.severity != base::Diagnostic::Severity::Note) {
      report_.messages.push_back(base::to_string(diagnostic));
    }
    if (diagnostic.severity == base::Diagnostic::Severity::Error && held_.on) {
      error = base::to_string(diagnostic);
    }
  }
  if (!next_.ok) {
    return refuse(error);
  }
  make_plan();
  held_.changes = held_.on && plan_.changes;
  report_.restarts = plan_.restarts;
  const bool returns = request_.back && held_.on;  // the report is that of the way there
  for (std::size_t i = 0; i < plan_.modules.size() && !returns; ++i) {
    const ModuleFate& fate = plan_.modules[i];
    report_.modules.push_back({fate.module, to_text(fate.kind), fate.text});
  }
  if (!report_.restarts.empty()) {
    held_.needs_restart = true;
    return refuse(held_.on ? report_.restarts.front() : "the node has to be restarted with this configuration");
  }
  if (held_.on && !held_.changes) {
    step_ = Step::Idle;
    return;
  }
  arrivals_.begin(next_, plan_);
  step_ = Step::Loading;
}

void ScheduleChange::make_plan() {
  plan_ = plan_schedule(parts_.config, parts_.run, next_.config, next_.check);
  if (!held_.on) {
    require_same_files(plan_, parts_.run, next_.config);
  } else if (!request_.back) {
    compare_routes();
  }
  setup_ = make_run_setup(next_.config, next_.check, parts_.options.node, parts_.placement);
  tasks_ = make_tasks(next_.config, next_.check, setup_, parts_.placement.core);
  for (const scheduler::Task& task : tasks_) {
    if (!parts_.engine.has_core(task.core)) {
      plan_.restarts.push_back(fmt::format("module {} is for core {}, on which no module runs",
                                           next_.config.modules[task.index].name, task.core));
    }
  }
  if (parts_.options.simulation.on) {
    set_work_times(tasks_, next_.config, parts_.options.simulation.measured);
  }
  if (!plan_.restarts.empty()) {
    return;  // the basic period may be another one
  }
  const std::int64_t basic = parts_.run.basic_period_ns;
  const bool in_plant = !parts_.options.board.empty() && !parts_.options.simulation.on;
  next_grid_ = following_grid(
      grid_, static_cast<std::uint64_t>(setup_.macro_period_ns / basic), basic,
      in_plant ? std::optional(parts_.run.epoch_ns.load() + rt::wall_ns() - rt::now_ns()) : std::nullopt);
  delay_periods(tasks_, setup_, static_cast<std::int64_t>(next_grid_.begin) * basic);
}

void ScheduleChange::loaded() {
  if (!arrivals_.errors().empty()) {
    report_.messages.insert(report_.messages.end(), arrivals_.errors().begin(), arrivals_.errors().end());
    held_.needs_restart = arrivals_.needs_restart();
    return refuse(held_.on ? arrivals_.errors().front() : "a module that is added cannot run here");
  }
  arrivals_.list_variables(report_);
  if (request_.dry_run) {
    (void)arrivals_.drop();
    step_ = Step::Idle;
    return answer(CommandResult::Done, "would take over, " + summary_of(plan_));
  }
  if (!arrivals_.place(plan_, setup_, tasks_)) {
    held_.needs_restart = true;
    return refuse("there is no room for the properties of a module that is added; restart the node");
  }
  renumber(tasks_, plan_.indices);
  step_ = Step::Starting;
}

// They start while the others run.
void ScheduleChange::start(rt::MonoTime now, const std::string& others) {
  const bool started = arrivals_.is_started(now);
  if (!arrivals_.failure().empty()) {
    fail(arrivals_.failure());
  } else if (started && !is_given_up()) {
    prepare(others);
  }
}

void ScheduleChange::prepare(const std::string& others) {
  if (!others.empty()) {
    return held_.on ? void() : fail(others);  // a deployment waits for it
  }
  if (const Status prepared = parts_.engine.prepare_change(tasks_); !prepared) {
    return fail("its threads cannot be started: " + describe(prepared.error()));
  }
  step_ = Step::Building;
}

void ScheduleChange::begin_waiting() {
  if (waits_for_tick()) {
    step_ = Step::Ready;
    return;
  }
  waits_for_any_tick_ = false;
  if (!arrivals_.enter()) {
    return fail(arrivals_.failure());
  }
  if (!propose(grid().ticks)) {
    return fail("no macro period began in time");
  }
  step_ = Step::Waiting;
}

// The change is at the begin of a macro period, or `step` ticks later, and so on.
bool ScheduleChange::propose(std::uint64_t step) {
  const scheduler::RunBlock& run = parts_.run;
  const auto wait = static_cast<std::uint64_t>(kLongestWaitNs / run.basic_period_ns);
  for (int i = 0; i < kProposals; ++i) {
    const std::uint64_t tick = next_in(grid(), run.tick.load()) + static_cast<std::uint64_t>(i) * grid().ticks;
    if (parts_.engine.change_at({tick, step, tick + wait})) {
      return true;
    }
  }
  return false;
}

void ScheduleChange::follow() {
  const Engine::Change change = parts_.engine.follow_change();
  if (step_ == Step::Waiting && change == Engine::Change::Prepared) {
    if (waits_for_tick()) {
      return fail("it missed the tick of the change: a run of a module was in progress; repeat it, or use --restart");
    }
    if (!std::exchange(waits_for_any_tick_, true) && propose(1)) {
      return;
    }
    return fail(fmt::format("in {} no tick began without a run in progress; restart the node",
                            base::format_duration(base::Nanos(kLongestWaitNs))));
  }
  if (step_ == Step::Waiting && change != Engine::Change::Waiting) {
    settle();
    step_ = Step::Leaving;
  }
  if (step_ == Step::Leaving && change == Engine::Change::None) {
    const std::vector<std::uint32_t> followers = added_by(plan_);
    for (const std::uint32_t module : std::exchange(plan_.ended, {})) {
      leavers_.push_back({module, true, followers});
    }
    step_ = Step::Idle;
    follow_held();
  }
}

// All cores run by it: from here on this is the configuration of the node.
void ScheduleChange::settle() {
  scheduler::RunBlock& run = parts_.run;
  previous_ = config_of_schedule(parts_.config, run);
  grid_ = next_grid_;
  held_.counts = waits_for_tick();
  for (std::size_t i = 0; i < plan_.indices.size(); ++i) {
    settle_module(i, plan_.indices[i]);
  }
  for (const std::uint32_t module : plan_.ended) {
    record(module).ended = true;
  }
  arrivals_.settle();
  parts_.config.file = next_.config.file;
  parts_.config.minimum_period = next_.config.minimum_period;
  follow_priorities(run);
  run.macro_period_ns = setup_.macro_period_ns;
  run.slot_count = static_cast<std::uint64_t>(setup_.macro_period_ns / run.basic_period_ns);
  const std::uint64_t number = run.schedule.load() + 1;
  rt::copy_text(run.schedule_files[number % 2], setup_.config_file);
  run.schedule_tick.store(parts_.engine.changed_at());
  run.schedule.store(number, std::memory_order_release);
  parts_.console.info("schedule {} ({}) counts since tick {}: {}", number, parts_.config.file.filename().string(),
                      parts_.engine.changed_at(), summary_of(plan_));
  answer(CommandResult::Done, "took over, " + summary_of(plan_));
}

void ScheduleChange::settle_module(std::size_t place, std::uint32_t index) {
  const scheduler::ModuleSetup& setup = setup_.modules[place];
  scheduler::ModuleRecord& to = record(index);
  to.overrun_policy = setup.overrun;
  to.priority = setup.priority;
  to.period_ns = setup.period_ns;
  to.offset_ns = setup.offset_ns;
  to.deadline_ns = setup.deadline_ns;
  to.budget_ns = setup.budget_ns;
  to.ended = false;
  config::Module& module = parts_.config.modules[index];
  next_.config.modules[place].file = module.file;
  next_.config.modules[place].file_as_written = module.file_as_written;
  module = std::move(next_.config.modules[place]);
}

void ScheduleChange::fail(const std::string& why) {
  parts_.engine.drop_change();
  for (const std::uint32_t module : arrivals_.drop()) {
    leavers_.push_back({module, false, {}});
  }
  step_ = parts_.engine.follow_change() == Engine::Change::None ? Step::Idle : Step::Leaving;
  plan_.ended.clear();
  answer(CommandResult::Failed, why);
}

// Nothing has begun.
void ScheduleChange::refuse(const std::string& why) {
  (void)arrivals_.drop();
  step_ = Step::Idle;
  answer(CommandResult::Refused, why);
}

void ScheduleChange::answer(CommandResult result, const std::string& text) {
  if (held_.on) {
    held_.failure = result == CommandResult::Done ? "" : text;
    held_.refused = held_.failure.empty() ? "" : arrivals_.refused();
  } else {
    respond(report_, result, text);
  }
  if (result != CommandResult::Done) {
    parts_.console.warning("the schedule has not changed: {}", text);
  }
}

void ScheduleChange::respond(operate::ScheduleReport report, CommandResult result, const std::string& text) const {
  report.text = text;
  report.schedule = parts_.run.schedule.load();
  report.tick = parts_.run.schedule_tick.load();
  (void)operate::write_schedule_report(parts_.options.node, report);
  scheduler::answer_command(record(0), result);
}

std::vector<ScheduleChange::Leaver> ScheduleChange::take_leavers() {
  return step_ == Step::Idle ? std::exchange(leavers_, {}) : std::vector<Leaver>();
}

void ScheduleChange::end() {
  const bool unanswered = step_ != Step::Idle && step_ != Step::Leaving;
  if (step_ == Step::Checking) {
    thread_.join();
  }
  if (step_ >= Step::Loading && step_ <= Step::Ready) {
    arrivals_.end();
  }
  step_ = Step::Idle;
  if (unanswered && !held_.on) {
    answer(CommandResult::Ending, "the node ends");
  }
}

}  // namespace indurop::node
