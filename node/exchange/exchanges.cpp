// SPDX-License-Identifier: Apache-2.0
// From the command to a version that is ready to run. The rest of the way is in exchanges_run.cpp.
#include "node/exchange/exchanges.h"

#include <utility>

#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::ModuleState;

constexpr std::chrono::seconds kStartLimit{10};  // for start() of a new version
constexpr std::chrono::milliseconds kPreparingPoll{1};

}  // namespace

Exchanges::Exchanges(const Parts& parts, const config::CheckResult& check, Phases phases)
    : parts_(parts),
      phases_(phases),
      allowed_(parts.config.modules.size()),
      retired_(parts.run, phases_, parts.console) {
  for (std::uint32_t i = 0; i < allowed_.size(); ++i) {
    if (i < check.facts.size()) {
      allowed_[i] = check.facts[i].file.access;
    }
    rt::copy_text(record(i).digests[1], parts.libraries[i].digest());
    record(i).version.store(parts.libraries[i].digest().empty() ? 0 : 1);
  }
}

Exchanges::~Exchanges() = default;

bool Exchanges::is_open(std::uint32_t module) const noexcept {
  return work_ && work_->module == module && work_->step >= Step::Waiting &&
         (work_->step != Step::Watched || work_->exchange->step() != scheduler::Exchange::Step::Done);
}

void Exchanges::poll(rt::MonoTime now) {
  retired_.poll(now);
  if (work_) {
    go_on(now);
  }
  for (std::uint32_t i = 0; i < parts_.run.module_count; ++i) {
    const ModuleCommand command = scheduler::waiting_command(record(i));
    const bool answers_later = work_ && work_->module == i && !work_->answered;
    if ((command == ModuleCommand::Reload || command == ModuleCommand::Back) && !answers_later) {
      accept(i, command);
    }
  }
  while (parts_.simulated && work_ && work_->step < Step::Waiting) {
    rt::sleep_until(rt::MonoClock::now() + kPreparingPoll);
    go_on(rt::MonoClock::now());
  }
}

void Exchanges::accept(std::uint32_t module, ModuleCommand command) {
  if (command == ModuleCommand::Back) {
    accept_back(module);
    return;
  }
  const auto request = operate::take_reload_request(parts_.node);
  if (work_) {
    answer_other(
        module, CommandResult::Refused,
        fmt::format("module {} is being exchanged; repeat the command when its health window is over", record().name));
  } else if (!request) {
    answer_other(module, CommandResult::Refused, "the request cannot be read; repeat the command");
  } else if (parts_.config.modules[module].type != scheduler::ModuleType::Thread) {
    answer_other(module, CommandResult::Refused,
                 "a process is not exchanged while it runs: `indurop restart` launches its new file");
  } else if (parts_.config.modules[module].operation == scheduler::Operation::NonReal) {
    answer_other(module, CommandResult::Refused,
                 "it runs in the background, where no run is waited for: stop and run the node to load its new file");
  } else {
    work_ = std::make_unique<Work>();
    work_->request = *request;
    prepare(module);
  }
}

void Exchanges::accept_back(std::uint32_t module) {
  if (work_ && work_->module == module && work_->step == Step::Watched) {
    work_->answered = false;
    if (!work_->exchange->go_back(scheduler::Exchange::Reason::Command)) {
      work_->then_back = scheduler::Exchange::Reason::Command;
      leave();
    }
  } else if (work_) {
    answer_other(module, CommandResult::Refused,
                 fmt::format("module {} is being exchanged; repeat the command when that is over", record().name));
  } else if (!previous_.contains(module)) {
    answer_other(module, CommandResult::Refused,
                 "there is no previous version of it in memory: name its file, `indurop reload MODULE FILE`");
  } else if (record(module).state.load() != ModuleState::Running) {
    answer_other(module, CommandResult::Refused,
                 "it does not run, so there is nothing to take over: start it, or name the file of the other version");
  } else {
    begin_back(module, false, scheduler::Exchange::Reason::Command);
  }
}

void Exchanges::begin_back(std::uint32_t module, bool answered, scheduler::Exchange::Reason reason) {
  work_ = std::make_unique<Work>();
  work_->module = module;
  work_->back = true;
  work_->answered = answered;
  work_->reason = reason;
  work_->other = std::move(previous_.extract(module).mapped());
  work_->carry = plan_carry(running().memory(), work_->other.memory(), most_in_tick(record().period_ns));
  work_->report.module = record().name;
  work_->report.plan = work_->carry.plan;
  work_->report.from = running().digest();
  work_->report.to = work_->other.digest();
  watch();
}

void Exchanges::prepare(std::uint32_t module) {
  work_->module = module;
  work_->report.module = record().name;
  work_->report.from = running().digest();
  if (!work_->request.guard.empty()) {
    auto guard = GuardCondition::parse(work_->request.guard, parts_.store);
    if (!guard) {
      answer(CommandResult::Refused, guard.error().text);
      work_.reset();
      return;
    }
    work_->guard = std::move(guard).value();
  }
  const config::Module& configured = parts_.config.modules[module];
  work_->preparation = std::make_unique<CandidateThread>(CandidateTask{
      parts_.config, module, work_->request.file.empty() ? configured.file : std::filesystem::path(work_->request.file),
      parts_.store, allowed_[module], running()});
}

void Exchanges::go_on(rt::MonoTime now) {
  switch (work_->step) {
    case Step::Preparing:
      return work_->preparation->is_done() ? prepared() : void();
    case Step::Starting:
      return phases_.ended(*work_->call, now, kStartLimit) ? started(now) : void();
    case Step::Waiting:
      return wait_for_exchange();
    case Step::Watched:
      return check_health();
    case Step::Leaving:
      return parts_.engine.has_passed(work_->module) ? has_left() : void();
  }
}

void Exchanges::prepared() {
  Candidate candidate = work_->preparation->take();
  work_->preparation.reset();
  if (!is_wanted(candidate)) {
    work_.reset();
    return;
  }
  work_->other = std::move(candidate.library);
  work_->carry = std::move(candidate.carry);
  start_other();
}

// Returns false if it was answered that nothing is exchanged.
bool Exchanges::is_wanted(Candidate& candidate) {
  operate::ReloadReport& report = work_->report;
  report.errors = candidate.errors;
  report.plan = candidate.carry.plan;
  report.to = candidate.library.digest();
  if (!report.errors.empty()) {
    answer(CommandResult::Refused, fmt::format("the new version cannot run here: {} error{}", report.errors.size(),
                                               report.errors.size() == 1 ? "" : "s"));
  } else if (report.from == report.to) {
    answer(CommandResult::Unchanged, "this version runs already");
  } else if (candidate.carry.loses && !work_->request.lossy) {
    answer(CommandResult::Refused, "values would be lost; --lossy exchanges it nevertheless");
  } else if (work_->request.dry_run) {
    answer(CommandResult::Done, report.plan.with_state ? "would be exchanged, with what it keeps"
                                                       : "would be exchanged, with initial values");
  } else {
    return true;
  }
  return false;
}

void Exchanges::start_other() {
  auto* start = work_->other.functions().start;
  if (start == nullptr || record().state.load() != ModuleState::Running) {
    return started(rt::MonoClock::now());
  }
  runtime::bind_apart(work_->other.inside());
  work_->call = phases_.begin(work_->module, "start", start);
  work_->step = Step::Starting;
  if (work_->call == nullptr) {
    abort("start() could not be called");
  }
}

void Exchanges::started(rt::MonoTime /*now*/) {
  const bool was_called = work_->call != nullptr;
  if (was_called) {
    if (const auto failure = Phases::failure_of(std::move(work_->call))) {
      work_->other_is_unsound = true;
      return abort(*failure);
    }
    runtime::bind_back(work_->other.inside());
  }
  if (record().state.load() == ModuleState::Running) {
    watch();
  } else if (was_called) {
    abort("the version that runs has faulted or was stopped meanwhile");
  } else {
    replace_closed();
  }
}

// It does not run, so that nothing has to be carried: `indurop start` calls start() of the new version.
void Exchanges::replace_closed() {
  const bool faulted = record().state.load() == ModuleState::Faulted;
  if (!parts_.engine.at_rest(work_->module)) {
    return abort("a run of it is still being ended; repeat the command");
  }
  parts_.engine.replace_closed(work_->module, {work_->other.functions().run, work_->other.functions().condition});
  std::swap(running(), work_->other);
  set_version(scheduler::VersionState::Settled);
  work_->other_is_unsound = faulted;
  answer(CommandResult::Done, "is stopped, and begins with this version at `indurop start`");
  if (faulted) {
    retired_.abandon(work_->module, std::move(work_->other));
  } else {
    work_->other.unload();  // its stop() was called
  }
  work_.reset();
}

void Exchanges::answer(CommandResult result, const std::string& text) {
  if (std::exchange(work_->answered, true)) {
    return;
  }
  work_->report.text = text;
  work_->report.version = record().version.load();
  (void)operate::write_report(parts_.node, work_->report);
  scheduler::answer_command(record(), result);
  if (result == CommandResult::Refused || result == CommandResult::Failed) {
    parts_.console.warning("module {}: not exchanged: {}", record().name, text);
  }
}

void Exchanges::answer_other(std::uint32_t module, CommandResult result, const std::string& text) {
  operate::ReloadReport report;
  report.module = record(module).name;
  report.text = text;
  report.version = record(module).version.load();
  (void)operate::write_report(parts_.node, report);
  scheduler::answer_command(record(module), result);
}

}  // namespace indurop::node
