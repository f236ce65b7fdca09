// SPDX-License-Identifier: Apache-2.0
#include "node/modules/module_commands.h"

#include <algorithm>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::ModuleState;
using scheduler::Operation;

constexpr std::chrono::seconds kLaunch{5};  // until a process is ready to be released
constexpr std::chrono::milliseconds kCommandPoll{1};

bool is_own(ModuleCommand command) noexcept {
  return command == ModuleCommand::Stop || command == ModuleCommand::Start || command == ModuleCommand::Restart;
}

}  // namespace

bool ModuleCommands::is_process(std::uint32_t module) const noexcept {
  return parts_.config.modules[module].type == scheduler::ModuleType::Process;
}

// A module that has left the schedule ends without a command: another one may be waiting in its record.
bool ModuleCommands::answer(const Work& work, CommandResult result) {
  const char* done = work.command == ModuleCommand::Stop ? "stopped" : "started";
  const base::Log log = parts_.console.about(record(work.module).name);
  if (record(work.module).ended) {
    log.info("module {}: ended", record(work.module).name);
    return true;
  }
  if (result == CommandResult::Done) {
    log.info("module {}: {} by command", record(work.module).name, done);
  } else if (result == CommandResult::OldCode) {
    log.warning(
        "module {}: started by command, with the code that was loaded when the node started; its file is another one "
        "now, stop and run the node to load it",
        record(work.module).name);
  } else if (result == CommandResult::Failed) {
    log.error("module {}: could not be {} as commanded", record(work.module).name, done);
  }
  scheduler::answer_command(record(work.module), result);
  return true;
}

void ModuleCommands::poll_schedule(rt::MonoTime now) {
  const std::string exchanged = schedule_.held().on ? "" : exchanges_.activity();
  schedule_.poll(now, works_.empty()
                          ? exchanged
                          : fmt::format("module {} is being started or stopped", record(works_.front().module).name));
  for (const ScheduleChange::Leaver& leaver : schedule_.take_leavers()) {
    take(leaver.module, ModuleCommand::Stop, now, leaver);
  }
}

void ModuleCommands::poll(rt::MonoTime now) {
  poll_schedule(now);
  if (schedule_.is_switching()) {
    return;
  }
  exchanges_.poll(now);
  for (std::uint32_t i = 0; i < parts_.run.module_count; ++i) {
    const ModuleCommand command = scheduler::waiting_command(record(i));
    const bool taken = std::any_of(works_.begin(), works_.end(), [i](const Work& work) { return work.module == i; });
    if (!is_own(command) || taken || exchanges_.is_open(i)) {
      continue;
    }
    if (record(i).ended) {
      scheduler::answer_command(record(i), CommandResult::Refused);
    } else {
      take(i, command, now);
    }
  }
  std::erase_if(works_, [&](Work& work) { return go_on(work, now); });
}

bool ModuleCommands::writes(std::uint32_t module, std::uint64_t variable) const {
  const ModuleLibrary::Uses& uses = parts_.libraries[module].uses();
  const std::vector<std::string>& declared = parts_.config.modules[module].writes;
  const auto use = uses.find(variable);
  return (use != uses.end() && use->second.writes) ||
         std::any_of(declared.begin(), declared.end(), [variable](const std::string& name) {
           return abi::fnv1a64(name.data(), name.size()) == variable;
         });
}

void ModuleCommands::take(std::uint32_t module, ModuleCommand command, rt::MonoTime now,
                          const std::optional<ScheduleChange::Leaver>& leaver) {
  const ModuleState state = record(module).state.load();
  const bool stopped = state == ModuleState::Stopped;
  const bool runs = state == ModuleState::Running || state == ModuleState::Starting;
  Work work{module, command, Step::Leaving, now, {nullptr, [](Phases::Call* /*none*/) {}}, leaver};
  if ((command == ModuleCommand::Stop && stopped) || (command == ModuleCommand::Start && runs)) {
    (void)answer(work, CommandResult::Unchanged);
    return;
  }
  if (!stopped) {
    leave(work, now);
  } else if (begin_start(work, now)) {
    return;
  }
  works_.push_back(std::move(work));
}

bool ModuleCommands::go_on(Work& work, rt::MonoTime now) {
  switch (work.step) {
    case Step::Leaving:
      return has_left(work, now) && call_stop(work, now);
    case Step::Stopping:
      if (!parts_.phases.ended(*work.call, now, Phases::kGrace)) {
        return false;
      }
      (void)parts_.phases.conclude(std::move(work.call));  // a failure is reported; the module is stopped all the same
      return rest(work, now);
    case Step::Starting:
      return parts_.phases.ended(*work.call, now, {}) &&
             (parts_.phases.conclude(std::move(work.call)) ? enter(work) : answer(work, CommandResult::Failed));
    case Step::Launching:
      return launched(work, now);
  }
  return true;
}

void ModuleCommands::leave(const Work& work, rt::MonoTime now) {
  if (is_process(work.module)) {
    parts_.processes.stop(work.module, now);
  } else if (!parts_.engine.disable(work.module)) {
    parts_.normal_threads.halt(work.module, now);
  }
}

bool ModuleCommands::has_left(const Work& work, rt::MonoTime now) {
  return parts_.processes.has_ended(work.module) && parts_.engine.at_rest(work.module) &&
         parts_.normal_threads.has_ended(work.module, now);
}

// Called when no run of the module is in progress any more: calls stop().
bool ModuleCommands::call_stop(Work& work, rt::MonoTime now) {
  record(work.module).state.store(ModuleState::Stopped);
  if (auto* stop = parts_.libraries[work.module].functions().stop; stop != nullptr) {
    work.call = parts_.phases.begin(work.module, "stop", stop);
    work.step = Step::Stopping;
  }
  return work.call == nullptr && rest(work, now);
}

// Finally writes the values declared for the case that the module is stopped.
bool ModuleCommands::rest(Work& work, rt::MonoTime now) {
  record(work.module).state.store(ModuleState::Stopped);
  if (!work.leaver) {
    parts_.failsafe.apply(work.module);
  } else if (work.leaver->has_run) {
    const std::vector<std::uint32_t>& followers = work.leaver->followers;
    parts_.failsafe.apply_except(work.module, [&](std::uint64_t variable) {
      return std::any_of(followers.begin(), followers.end(),
                         [&](std::uint32_t follower) { return writes(follower, variable); });
    });
  }
  return work.command == ModuleCommand::Stop ? answer(work, CommandResult::Done) : begin_start(work, now);
}

bool ModuleCommands::begin_start(Work& work, rt::MonoTime now) {
  work.began = now;
  if (is_process(work.module)) {
    work.step = Step::Launching;
    return !parts_.processes.start(work.module) && answer(work, CommandResult::Failed);
  }
  auto* start = parts_.libraries[work.module].functions().start;
  if (start == nullptr) {
    return enter(work);
  }
  work.call = parts_.phases.begin(work.module, "start", start);
  work.step = Step::Starting;
  return work.call == nullptr && answer(work, CommandResult::Failed);
}

// A thread module keeps its code as long as the node runs; a user who has built another one must be informed.
CommandResult ModuleCommands::started(std::uint32_t module) const {
  return parts_.libraries[module].is_outdated() ? CommandResult::OldCode : CommandResult::Done;
}

bool ModuleCommands::enter(Work& work) {
  if (parts_.config.modules[work.module].operation == Operation::NonReal) {
    return answer(work, parts_.normal_threads.launch(work.module) ? started(work.module) : CommandResult::Failed);
  }
  if (tape::Track* track = parts_.tape == nullptr ? nullptr : parts_.tape->of(work.module)) {
    track->note_restart();
  }
  record(work.module).state.store(ModuleState::Running);
  parts_.engine.enable(work.module);
  return answer(work, started(work.module));
}

bool ModuleCommands::launched(Work& work, rt::MonoTime now) {
  switch (record(work.module).state.load()) {
    case ModuleState::Running:
    case ModuleState::Exited:
      return answer(work, CommandResult::Done);
    case ModuleState::Restarting:
    case ModuleState::Faulted:
      return answer(work, CommandResult::Failed);
    case ModuleState::Loaded:
    case ModuleState::Starting:
    case ModuleState::Stopped:
      break;
  }
  return now - work.began > kLaunch && answer(work, CommandResult::Failed);
}

void ModuleCommands::end() {
  for (Work& work : works_) {
    if (work.call != nullptr) {
      while (!parts_.phases.ended(*work.call, rt::MonoClock::now(), Phases::kGrace)) {
        rt::sleep_until(rt::MonoClock::now() + kCommandPoll);
      }
      if (parts_.phases.conclude(std::move(work.call)) && work.step == Step::Starting) {
        record(work.module).state.store(ModuleState::Loaded);  // it has started, so its stop() will be called
      }
    }
    (void)answer(work, CommandResult::Ending);
  }
  works_.clear();
  schedule_.end();
  exchanges_.end();
}

}  // namespace indurop::node
