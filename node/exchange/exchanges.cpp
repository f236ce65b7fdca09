// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/exchanges.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/exchange_kind.h"
#include "node/exchange/module_exchange.h"
#include "scheduler/module_version.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::ModuleState;

constexpr std::chrono::milliseconds kPreparingPoll{1};

}  // namespace

Exchanges::Exchanges(const Parts& parts, const config::CheckResult& check, const Phases& phases)
    : context_{parts, phases, std::vector<AllowedAccess>(parts.config.modules.size()), {},
               {},    {},     Retired(parts.run, context_.phases, parts.console)},
      set_(context_) {
  for (std::uint32_t i = 0; i < context_.allowed.size(); ++i) {
    if (i < check.facts.size()) {
      context_.allowed[i] = check.facts[i].file.access;
      context_.parts.libraries[i].set_uses(uses_of(check.facts[i]));
    }
    context_.configured.push_back(configured_uses_of(check, i, parts.config.modules[i].name));
    begin_version(i);
  }
}

void Exchanges::begin_version(std::uint32_t module) {
  ModuleLibrary& library = context_.parts.libraries[module];
  const std::string& digest = library.digest();
  context_.files.push_back(context_.parts.config.modules[module].file);
  if (context_.track_of(module) != nullptr && !digest.empty()) {
    const std::string file = std::filesystem::absolute(library.file()).string();
    library.set_number(context_.parts.tape->versions().add_first(module, digest, file));
    context_.set_on_track(module, library);
  }
  if (!digest.empty()) {  // of a process, it is known when it is launched
    scheduler::set_version(record(module), digest, 0, scheduler::VersionState::Settled);
  }
}

void Exchanges::add(const AllowedAccess& access, ConfiguredUses configured) {
  context_.allowed.push_back(access);
  context_.configured.push_back(std::move(configured));
  begin_version(static_cast<std::uint32_t>(context_.files.size()));
}

bool Exchanges::is_open(std::uint32_t module) const noexcept {
  return (single_ && module_ == module && single_->is_open()) || set_.is_open(module);
}

std::string Exchanges::exchanged_module() const {
  return is_under_way() ? record(module_).name : "";
}

std::string Exchanges::activity() const {
  return is_under_way()        ? fmt::format("module {} is being exchanged", exchanged_module())
         : set_.is_under_way() ? "a deployment exchanges modules"
                               : "";
}

void Exchanges::poll(rt::MonoTime now) {
  context_.retired.poll(now);
  go_on(now);
  set_.poll(now);
  for (std::uint32_t i = 0; i < context_.parts.run.module_count; ++i) {
    const ModuleCommand command = scheduler::waiting_command(record(i));
    const bool answers_later = module_ == i && single_ && !single_->result();
    if (command == ModuleCommand::Exchange) {
      set_.command(exchanged_module());
    } else if ((command == ModuleCommand::Reload || command == ModuleCommand::Back) && !answers_later) {
      accept(i, command);
    }
  }
  while (context_.parts.simulated && single_ && !single_->is_prepared()) {
    rt::sleep_until(rt::MonoClock::now() + kPreparingPoll);
    go_on(rt::MonoClock::now());
  }
}

void Exchanges::go_on(rt::MonoTime now) {
  if (single_) {
    single_->go_on(now);
    if (single_->is_over()) {
      single_.reset();
    }
  }
}

void Exchanges::accept(std::uint32_t module, ModuleCommand command) {
  if (set_.is_under_way()) {
    answer(module, CommandResult::Refused, "a deployment exchanges modules; repeat the command when that is over");
    return;
  }
  if (command == ModuleCommand::Back) {
    accept_back(module);
    return;
  }
  const auto request = operate::take_reload_request(context_.parts.node);
  const config::Module& configured = context_.parts.config.modules[module];
  if (is_under_way()) {
    answer(module, CommandResult::Refused,
           fmt::format("module {} is being exchanged; repeat the command when its health window is over",
                       exchanged_module()));
  } else if (record(module).ended) {
    answer(module, CommandResult::Refused, "it has ended: the schedule is without it");
  } else if (!request) {
    answer(module, CommandResult::Refused, "the request cannot be read; repeat the command");
  } else if (const char* why = why_not_exchanged(configured, context_.parts.simulated); why != nullptr) {
    answer(module, CommandResult::Refused, why);
  } else {
    module_ = module;
    single_ = make_exchange(context_, module, false);
    single_->begin(*request);
  }
}

void Exchanges::accept_back(std::uint32_t module) {
  if (single_ && module_ == module && single_->is_watched()) {
    single_->await_answer();
    single_->go_back();
  } else if (is_under_way()) {
    answer(module, CommandResult::Refused,
           fmt::format("module {} is being exchanged; repeat the command when that is over", exchanged_module()));
  } else if (!context_.previous.contains(module)) {
    answer(module, CommandResult::Refused,
           "there is no previous version of it in memory: name its file, `indurop reload MODULE FILE`");
  } else if (record(module).state.load() != ModuleState::Running) {
    answer(module, CommandResult::Refused,
           "it does not run, so there is nothing to take over: start it, or name the file of the other version");
  } else {
    module_ = module;
    auto exchange = std::make_unique<ModuleExchange>(context_, module, false);
    exchange->begin_back(scheduler::Exchange::Reason::Command);
    single_ = std::move(exchange);
  }
}

void Exchanges::answer(std::uint32_t module, CommandResult result, const std::string& text) {
  operate::ReloadReport report;
  report.module = record(module).name;
  report.text = text;
  report.version = record(module).version.load();
  (void)operate::write_report(context_.parts.node, report);
  scheduler::answer_command(record(module), result);
}

void Exchanges::end() {
  if (single_) {
    single_->end();
    single_.reset();
  }
  set_.end();
  for (auto& [module, library] : context_.previous) {
    context_.retired.add(module, std::move(library));
  }
  context_.previous.clear();
  context_.retired.end();
}

}  // namespace indurop::node
