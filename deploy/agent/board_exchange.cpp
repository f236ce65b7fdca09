// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_exchange.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <utility>

#include "core/rt/fixed_text.h"
#include "deploy/agent/running_node.h"
#include "scheduler/module_version.h"
#include "store/vars/node_lock.h"

namespace indurop::deploy {
namespace {

using operate::SetRequest;
using scheduler::CommandResult;
using State = operate::SetReport::State;
using scheduler::RunBlock;

constexpr std::chrono::seconds kToSettle{5};
constexpr std::chrono::milliseconds kSettlePoll{10};

// A node without modules has nothing that could take a command.
std::optional<vars::RunFile> run_of(const std::string& board) {
  auto file = open_running_node(board);
  return file && run_block(*file).module_count > 0 ? std::move(file) : std::nullopt;
}

std::map<std::string, std::string> running_versions(const RunBlock& block) {
  std::map<std::string, std::string> digests;
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    const scheduler::ModuleRecord& module = block.modules()[i];
    if (std::string digest = scheduler::running_digest(module); !digest.empty()) {
      digests[module.name] = std::move(digest);
    }
  }
  return digests;
}

ModulePlan::Act act_of(const operate::ReloadPlan& plan) noexcept {
  return !plan.compared                            ? ModulePlan::Act::Open
         : plan.with_state || plan.why_not.empty() ? ModulePlan::Act::Exchanged
                                                   : ModulePlan::Act::Fresh;
}

std::string why_of(const operate::ReloadReport& report) {
  const operate::ReloadPlan& plan = report.plan;
  if (!plan.compared) {
    return "what it carries is known when its new process runs";
  }
  if (!plan.with_state) {
    return plan.why_not.empty() ? "it keeps nothing" : plan.why_not;
  }
  std::string text = fmt::format("{} kept, {} bytes", plan.kept.size() + plan.grown.size(), plan.bytes);
  const auto add = [&text](const char* word, const std::vector<std::string>& names) {
    if (!names.empty()) {
      text += fmt::format("; {}: {}", word, fmt::join(names, ", "));
    }
  };
  add("added", plan.added);
  add("removed", plan.removed);
  add("new", plan.appeared);
  add("initial value", plan.changed);
  return text;
}

}  // namespace

RunBlock& BoardExchange::run() const noexcept {
  return run_block(*run_);
}

bool BoardExchange::open_run() {
  run_ = run_of(board_);
  return run_.has_value();
}

void BoardExchange::load(Task task) {
  task_ = std::move(task);
  load_is_due_ = true;
  if (stage_ != Stage::Deciding) {
    begin_load();
  }
}

void BoardExchange::begin_load() {
  load_is_due_ = false;
  drop();
  const bool runs = task_.node_runs && open_run();
  const bool same = runs && rt::text_of(run().deployment) == task_.from;
  DeploymentChange change = change_between(state_, board_, task_.from, task_.to,
                                           runs ? running_versions(run()) : std::map<std::string, std::string>());
  if (change.plan.restart.empty() && !same) {
    change.plan.restart = runs ? "its node runs another deployment" : "its node does not run";
  }
  board_plan_ = std::move(change.plan);
  early_.clear();
  answers_ = true;
  stage_ = Stage::Loading;
  grid_ns_ = 0;
  if (board_plan_.restart.empty()) {
    auto lock = operate::ReloadLock::acquire(board_);
    if (lock) {
      lock_.emplace(std::move(lock).value());
      request({task_.compare ? SetRequest::Act::Compare : SetRequest::Act::Prepare, task_.to,
               std::move(change.exchanged), 0, std::move(change.manifest)},
              Stage::Loading);
    } else {
      early_ = "a process on the board is exchanging a module";
    }
  }
  plan_ = text_of(board_plan_);
}

void BoardExchange::enter(rt::MonoTime at, bool alone) {
  answers_ = true;
  stage_ = Stage::Entering;
  if (!lock_ || !run_) {
    early_ = "its node has nothing to exchange";
    return;
  }
  const operate::SetReport report = report_of_node();
  const auto grid = static_cast<std::int64_t>(std::max<std::uint64_t>(report.grid_ticks, 1));
  const auto begin = static_cast<std::int64_t>(report.grid_begin);
  const std::int64_t period = run().basic_period_ns * grid;
  const std::int64_t since = rt::to_ns(at) - run().epoch_ns.load() - run().basic_period_ns * begin;
  const std::int64_t steps = std::max<std::int64_t>((since + (alone ? period - 1 : period / 2)) / period, 0);
  request({SetRequest::Act::Exchange, task_.to, {}, static_cast<std::uint64_t>(begin + steps * grid), ""},
          Stage::Entering);
}

void BoardExchange::decide(const std::string& deployment) {
  load_is_due_ = false;
  if (!lock_) {
    return;
  }
  answers_ = true;
  decided_ = deployment;
  early_.clear();
  request({SetRequest::Act::Decide, deployment, {}, 0, ""}, Stage::Deciding);
}

void BoardExchange::request(SetRequest request, Stage stage) {
  request_ = std::move(request);
  stage_ = stage;
}

void BoardExchange::drop() {
  lock_.reset();
  run_.reset();
  request_.reset();
  ticket_.reset();
  answers_ = false;
  early_.clear();
  stage_ = Stage::Idle;
}

// Returns true when the command is with the node, and it has answered it.
bool BoardExchange::place() {
  scheduler::ModuleRecord& first = run().modules()[0];
  if (ticket_ && scheduler::result_of(first, *ticket_) == CommandResult::None) {
    return false;
  }
  if (request_) {
    const Status written = state_.reserve().use_for([this] { return operate::write_set_request(board_, *request_); });
    if (!written && stage_ == Stage::Deciding && written.error().sys_errno == ENOSPC) {
      return false;  // it has to receive this, so it is repeated until there is space
    }
    if (!written) {
      early_ = describe_unwritten(written.error());
      request_.reset();
      return true;
    }
    ticket_ = scheduler::place_command(first, scheduler::ModuleCommand::Exchange);
    if (ticket_) {
      request_.reset();
    }
    return false;
  }
  const CommandResult result = scheduler::result_of(first, *ticket_);
  if (result != CommandResult::Done && early_.empty()) {
    const operate::SetReport report = report_of_node();
    early_ = report.problem.empty() ? "its node does not do it" : report.problem;
  }
  return true;
}

std::optional<BoardExchange::Answer> BoardExchange::poll() {
  if (load_is_due_ && stage_ != Stage::Deciding) {
    begin_load();
  }
  if (!answers_) {
    return std::nullopt;
  }
  if (!lock_) {
    return done(early_);
  }
  if (vars::running_node(board_) != run().node_pid.load()) {
    return done(stage_ == Stage::Deciding ? "" : "its node ended");  // the next one runs what it is started with
  }
  auto answer = place() ? answer_of_node() : std::nullopt;
  if (!answer) {
    state_.reserve().give_if_full();  // the node may be waiting for space for its report
  }
  return answer;
}

std::optional<BoardExchange::Answer> BoardExchange::answer_of_node() {
  switch (stage_) {
    case Stage::Loading:
      return loaded();
    case Stage::Entering:
      return entered();
    case Stage::Deciding:
      return decided();
    case Stage::Idle:
    case Stage::Loaded:
    case Stage::Entered:
      break;
  }
  return std::nullopt;
}

BoardExchange::Answer BoardExchange::done(const std::string& problem, bool exchanges) {
  answers_ = false;
  Answer answer{stage_ == Stage::Loading    ? Done::Loaded
                : stage_ == Stage::Entering ? Done::Entered
                                            : Done::Decided,
                problem, exchanges};
  plan_ = text_of(board_plan_);
  if (stage_ == Stage::Deciding || (stage_ == Stage::Loading && (!exchanges || task_.compare))) {
    drop();
  } else {
    stage_ = stage_ == Stage::Loading ? Stage::Loaded : Stage::Entered;
  }
  return answer;
}

// Completes the plan by what the node has found.
void BoardExchange::describe(const operate::SetReport& report) {
  for (const operate::ReloadReport& module : report.modules) {
    const auto found = std::find_if(board_plan_.modules.begin(), board_plan_.modules.end(),
                                    [&](const ModulePlan& one) { return one.module == module.module; });
    if (found == board_plan_.modules.end()) {
      continue;
    }
    if (module.module == report.refused && !report.needs_restart) {
      found->act = ModulePlan::Act::Refused;
      found->why = module.errors.empty() ? module.text : module.errors.front();
    } else {
      found->act = act_of(module.plan);
      found->why = why_of(module);
    }
    board_plan_.tick = std::max(board_plan_.tick, module.tick);
    board_plan_.left_out = std::max(board_plan_.left_out, module.left_out);
  }
  describe_schedule(report);
}

void BoardExchange::describe_schedule(const operate::SetReport& report) {
  board_plan_.schedule_tick = report.schedule_tick;
  for (ModulePlan& module : board_plan_.modules) {
    const auto found = std::find_if(report.schedule.begin(), report.schedule.end(),
                                    [&](const auto& one) { return one.name == module.module; });
    if (module.module == report.refused && !report.needs_restart) {
      module.act = ModulePlan::Act::Refused;
      module.why = report.problem;
    } else if (found != report.schedule.end() && found->fate == "added") {
      module.why = found->text;
    } else if (found != report.schedule.end() && found->fate == "rescheduled") {
      const bool kept = module.act == ModulePlan::Act::Kept || module.act == ModulePlan::Act::Rescheduled;
      module.act = kept ? ModulePlan::Act::Rescheduled : module.act;
      module.why = kept || module.why.empty() ? found->text : module.why + "; " + found->text;
    }
  }
}

std::optional<BoardExchange::Answer> BoardExchange::loaded() {
  const operate::SetReport report = report_of_node();
  if (early_.empty() && (report.state == State::Preparing || report.state == State::Leaving)) {
    return std::nullopt;
  }
  describe(report);
  if (early_.empty() && (report.state == State::Ready || report.state == State::Compared)) {
    grid_ns_ = run().basic_period_ns * static_cast<std::int64_t>(report.grid_ticks);
    return done("", true);
  }
  const std::string problem = early_.empty() ? report.problem : early_;
  if (report.needs_restart) {
    board_plan_.restart = problem;
    return done("");
  }
  return done(problem.empty() ? "its node left no report" : problem);
}

std::optional<BoardExchange::Answer> BoardExchange::entered() {
  const operate::SetReport report = report_of_node();
  if (early_.empty() && (report.state == State::Waiting || report.state == State::Leaving)) {
    return std::nullopt;
  }
  if (early_.empty() && report.state == State::Exchanged) {
    describe(report);
    return done("");
  }
  const std::string problem = early_.empty() ? report.problem : early_;
  return done(problem.empty() ? "its node left no report" : problem);
}

std::optional<BoardExchange::Answer> BoardExchange::decided() {
  const State state = report_of_node().state;
  if (early_.empty() && state == State::Leaving) {
    return std::nullopt;
  }
  const bool runs = rt::text_of(run().deployment) == decided_ && state != State::Stuck;
  return done(runs ? "" : "its node runs another deployment");
}

std::string BoardExchange::returned() {
  if (stage_ != Stage::Entered) {
    return "";
  }
  const operate::SetReport report = report_of_node();
  return report.state == State::Exchanged ? "" : report.problem.empty() ? "its node has given up" : report.problem;
}

// The report of an earlier node does not count.
operate::SetReport BoardExchange::report_of_node() const {
  auto report = operate::read_set_report(board_);
  return report && report->node_pid == run().node_pid.load() ? *std::move(report) : operate::SetReport();
}

void BoardExchange::settle(const std::string& board, const AgentState& state) {
  const auto file = vars::running_node(board) > 0 ? run_of(board) : std::nullopt;
  const SetRequest decision{SetRequest::Act::Decide, state.committed().current, {}, 0, ""};
  if (!file || !state.reserve().use_for([&] { return operate::write_set_request(board, decision); })) {
    return;
  }
  scheduler::ModuleRecord& first = run_block(*file).modules()[0];
  std::optional<scheduler::CommandTicket> ticket;
  for (const rt::MonoTime end = rt::MonoClock::now() + kToSettle; rt::MonoClock::now() < end;) {
    const auto report = operate::read_set_report(board);
    if (!ticket) {
      ticket = scheduler::place_command(first, scheduler::ModuleCommand::Exchange);
    } else if (scheduler::result_of(first, *ticket) != CommandResult::None &&
               (!report || report->state != State::Leaving)) {
      return;
    }
    rt::sleep_until(rt::MonoClock::now() + kSettlePoll);
  }
}

}  // namespace indurop::deploy
