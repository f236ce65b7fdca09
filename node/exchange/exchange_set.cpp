// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/exchange_set.h"

#include <algorithm>
#include <utility>

#include "core/rt/copy_text.h"
#include "node/exchange/exchange_kind.h"
#include "node/exchange/schedule_change.h"
#include "scheduler/module_state_text.h"

namespace indurop::node {
namespace {

using operate::SetRequest;
using scheduler::CommandResult;
using State = operate::SetReport::State;

constexpr std::size_t kShownDigits = 12;
constexpr std::chrono::milliseconds kWriteAgain{200};
constexpr std::uint32_t kNoSuchModule = ~std::uint32_t{0};

std::uint32_t index_of(const scheduler::RunBlock& run, const std::string& name) {
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    if (name == run.modules()[i].name) {
      return i;
    }
  }
  return kNoSuchModule;
}

}  // namespace

// The report comes before anything that its readers do about it.
void ExchangeSet::set_state(State state) {
  report_.state = state;
  report_.node_pid = context_.parts.run.node_pid.load();
  report_.modules.clear();
  for (const std::uint32_t module : order_) {
    report_.modules.push_back(all_.at(module)->report());
  }
  const ScheduleChange& schedule = *context_.schedule;
  const MacroGrid grid = schedule.common_with_next();
  report_.grid_ticks = grid.ticks;
  report_.grid_begin = grid.begin;
  report_.schedule = schedule.held().on ? schedule.report().modules : std::vector<operate::ScheduleReport::Module>();
  report_.schedule_tick = schedule.held().counts ? context_.parts.run.schedule_tick.load() : 0;
  write_report(rt::MonoClock::now());
}

void ExchangeSet::write_report(rt::MonoTime now) {
  const Status written = operate::write_set_report(context_.parts.node, report_);
  if (!written && !write_at_) {
    context_.parts.console.warning("the state of the exchange cannot be written: {}; it is tried again",
                                   describe(written.error()));
  }
  write_at_ = written ? std::nullopt : std::optional(now + kWriteAgain);
}

bool ExchangeSet::is_under_way() const noexcept {
  switch (report_.state) {
    case State::Preparing:
    case State::Ready:
    case State::Waiting:
    case State::Exchanged:
    case State::Leaving:
      return true;
    case State::None:
    case State::Compared:
    case State::Undone:
    case State::Stuck:
      break;
  }
  return false;
}

bool ExchangeSet::is_open(std::uint32_t module) const noexcept {
  const auto found = all_.find(module);
  return found != all_.end() && found->second->is_open();
}

void ExchangeSet::poll(rt::MonoTime now) {
  for (const auto& [module, exchange] : all_) {
    exchange->go_on(now);
  }
  go_on();
  if (write_at_ && now >= *write_at_) {
    write_report(now);
  }
}

void ExchangeSet::command(const std::string& single) {
  const std::string refusal = accept(single);
  if (!refusal.empty()) {
    context_.parts.console.warning("modules are not exchanged: {}", refusal);
    report_.problem = refusal;
    set_state(report_.state);
  }
  scheduler::answer_command(context_.parts.run.modules()[0],
                            refusal.empty() ? CommandResult::Done : CommandResult::Refused);
}

std::string ExchangeSet::accept(const std::string& single) {
  const auto request = operate::take_set_request(context_.parts.node);
  if (!request) {
    return "the request cannot be read";
  }
  switch (request->act) {
    case SetRequest::Act::Compare:
    case SetRequest::Act::Prepare:
      return single.empty()
                 ? begin(*request)
                 : fmt::format("module {} is being exchanged; repeat it when its health window is over", single);
    case SetRequest::Act::Exchange:
      return exchange(request->tick);
    case SetRequest::Act::Decide:
      return decide(request->deployment);
  }
  return "";
}

std::string ExchangeSet::begin(const SetRequest& request) {
  if (is_under_way() || !context_.schedule->is_at_rest()) {
    return "other modules are being exchanged";
  }
  report_ = {};
  keeps_new_ = false;
  scheduler::RunBlock& run = context_.parts.run;
  std::vector<std::pair<std::uint32_t, operate::ReloadRequest>> begins;
  for (const SetRequest::Module& module : request.modules) {
    const std::uint32_t index = index_of(run, module.name);
    if (index == kNoSuchModule ||
        why_not_exchanged(context_.parts.config.modules[index], context_.parts.simulated) != nullptr) {
      report_.needs_restart = true;
      return fmt::format("module {} is none that is exchanged while it runs", module.name);
    }
    if (!scheduler::is_up(run.modules()[index].state.load())) {
      report_.needs_restart = true;
      return fmt::format("module {} does not run", module.name);
    }
    operate::ReloadRequest& one = begins.emplace_back(index, operate::ReloadRequest{}).second;
    one.file = module.file;
    one.lossy = true;  // the nodes would begin with initial values otherwise
    one.dry_run = request.act == SetRequest::Act::Compare;
  }
  compares_ = request.act == SetRequest::Act::Compare;
  before_ = run.deployment;
  after_ = request.deployment;
  if (!request.config.empty()) {
    context_.schedule->hold(request.config, compares_);
  }
  set_state(State::Preparing);
  for (const auto& [index, one] : begins) {
    order_.push_back(index);
    files_[index] = one.file;
    all_.try_emplace(index, make_exchange(context_, index, true)).first->second->begin(one);
  }
  return "";
}

// The gates of all modules must be watched before the tick.
std::string ExchangeSet::exchange(std::uint64_t tick) {
  if (report_.state != State::Ready) {
    return "no modules are ready to be exchanged";
  }
  for (const auto& [module, exchange] : all_) {
    if (exchange->is_ready()) {
      exchange->enter(tick);
    }
  }
  context_.schedule->enter(tick);
  set_state(State::Waiting);
  if (const std::uint64_t next = context_.parts.run.tick.load(); next >= tick) {
    fail(fmt::format("it missed the tick of the exchange, {}: it was in tick {} when the order came", tick, next));
  }
  return "";
}

std::string ExchangeSet::decide(const std::string& deployment) {
  if (!is_under_way()) {
    const std::string running = context_.parts.run.deployment;
    return running == deployment && report_.state != State::Stuck ? "" : "there is nothing to decide";
  }
  if (report_.state == State::Exchanged && deployment == after_) {
    keeps_new_ = true;
    for (const auto& [module, exchange] : all_) {
      exchange->settle();
    }
    set_state(State::Leaving);
    return "";
  }
  if (deployment != before_) {
    return fmt::format("deployment {} is not one of the two", deployment);
  }
  if (keeps_new_ || report_.state != State::Leaving) {
    fail("");
  }
  return "";
}

// All previous versions are to run again.
void ExchangeSet::fail(const std::string& why) {
  report_.problem = why;
  keeps_new_ = false;
  for (const auto& [module, exchange] : all_) {
    exchange->go_back();
  }
  context_.schedule->go_back();
  set_state(State::Leaving);
}

void ExchangeSet::go_on() {
  switch (report_.state) {
    case State::Preparing:
      return conclude_preparation();
    case State::Waiting:
    case State::Exchanged:
      return follow_exchange();
    case State::Ready:
      for (const auto& [module, exchange] : all_) {
        if (!scheduler::is_up(context_.parts.run.modules()[module].state.load())) {
          return fail(fmt::format("module {} does not run any more", context_.parts.run.modules()[module].name));
        }
      }
      return;
    case State::Leaving:
      return conclude();
    case State::None:
    case State::Compared:
    case State::Undone:
    case State::Stuck:
      return;
  }
}

void ExchangeSet::conclude_preparation() {
  for (const auto& [module, exchange] : all_) {
    if (!exchange->is_prepared()) {
      return;
    }
    if (exchange->result() == CommandResult::Refused || exchange->result() == CommandResult::Failed) {
      const operate::ReloadReport& one = exchange->report();
      report_.needs_restart = one.needs_restart;
      report_.refused = one.module;
      return fail(fmt::format("module {}: {}", one.module, one.errors.empty() ? one.text : one.errors.front()));
    }
  }
  const ScheduleChange& schedule = *context_.schedule;
  if (!schedule.is_prepared()) {
    return;
  }
  if (!schedule.held().failure.empty()) {
    report_.needs_restart = schedule.held().needs_restart;
    report_.refused = schedule.held().refused;
    return fail(schedule.held().failure);
  }
  if (compares_) {
    set_state(State::Compared);
    return forget();
  }
  context_.schedule->open_routes();
  set_state(State::Ready);
}

void ExchangeSet::follow_exchange() {
  const ScheduleChange::Held& schedule = context_.schedule->held();
  if (!schedule.failure.empty()) {
    return fail(schedule.failure);
  }
  bool all_new = schedule.counts || !schedule.changes;
  for (const auto& [module, exchange] : all_) {
    const bool unchanged = exchange->is_over() && exchange->result() == CommandResult::Unchanged;
    if (exchange->result() == CommandResult::Failed || (exchange->is_over() && !unchanged && !exchange->runs_new())) {
      return fail(fmt::format("module {}: {}", exchange->report().module, exchange->report().text));
    }
    all_new = all_new && (unchanged || exchange->has_exchanged() || exchange->is_over());
  }
  if (all_new && report_.state == State::Waiting) {
    run_deployment(after_);
    set_state(State::Exchanged);
  }
}

// A version that failed while it was decided to keep it has returned all the same.
void ExchangeSet::conclude() {
  const ScheduleChange& schedule = *context_.schedule;
  if (!schedule.is_at_rest()) {
    return;
  }
  bool any_new = schedule.held().counts;
  bool any_old = schedule.held().changes && !schedule.held().counts;
  for (const auto& [module, exchange] : all_) {
    if (!exchange->is_over()) {
      return;
    }
    any_new = any_new || exchange->runs_new();
    any_old = any_old || (!exchange->runs_new() && exchange->result() != CommandResult::Unchanged);
  }
  const bool mixed = keeps_new_ ? any_old : any_new;
  if (!mixed) {
    context_.schedule->settle_routes(keeps_new_);
  }
  if (keeps_new_ && !mixed) {
    for (const auto& [module, file] : files_) {
      context_.files[module] = file;
    }
  } else if (!mixed && before_ != context_.parts.run.deployment) {
    run_deployment(before_);
  }
  set_state(mixed ? State::Stuck : keeps_new_ ? State::None : State::Undone);
  forget();
}

void ExchangeSet::forget() {
  context_.schedule->release();
  all_.clear();
  order_.clear();
  files_.clear();
}

void ExchangeSet::run_deployment(const std::string& id) {
  rt::copy_text(context_.parts.run.deployment, id);
  context_.parts.console.info("deployment {} runs", id.substr(0, kShownDigits));
}

void ExchangeSet::end() {
  for (const auto& [module, exchange] : all_) {
    exchange->end();
  }
  set_state(State::None);
  forget();
}

}  // namespace indurop::node
