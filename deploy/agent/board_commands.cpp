// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_commands.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "core/rt/clock.h"
#include "deploy/agent/action_kinds.h"
#include "deploy/agent/board_alarms.h"
#include "deploy/agent/board_audit.h"
#include "deploy/agent/running_node.h"
#include "deploy/agent/trust_lists.h"
#include "store/operate/journal.h"
#include "store/vars/box_request.h"

namespace indurop::deploy {
namespace {

using scheduler::CommandResult;

constexpr std::chrono::seconds kNonce{30};     // validity of an issued number
constexpr std::chrono::seconds kPatience{20};  // timeout of one command
constexpr std::size_t kMaxCommanders = 64;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// As the audit log has it.
std::string outcome_of(const CommandReply& done) {
  return done.outcome == Outcome::Done ? "done" : done.outcome == Outcome::Unchanged ? "unchanged" : done.text;
}

std::uint64_t new_nonce() {
  std::random_device random;
  const std::uint64_t high = random();
  return (high << 32U | random()) | 1U;  // never 0
}

// "by HOST (USER: REASON)", as far as the client sent it.
std::string by(const Command& command, const WriteOrder& words) {
  if (words.who.empty()) {
    return command.host;
  }
  return fmt::format("{} ({}{}{})", command.host, words.who, words.reason.empty() ? "" : ": ", one_line(words.reason));
}

}  // namespace

BoardCommands::BoardCommands(std::string board, std::uint64_t self, const DeployKeys& keys, AgentState& state,
                             BoardProcess& process, BoardRecorder& recorder, const base::Log& log)
    : board_(std::move(board)),
      forces_(board_),
      self_(self),
      keys_(keys),
      users_(board_, keys),
      process_(process),
      node_(process),
      recorder_(recorder),
      reload_(state, self, board_),
      log_(log) {}

CommandReply BoardCommands::reply(const Command& command, Outcome outcome, const std::string& text) const {
  return {command.commander, board_, self_, command.nonce, outcome, text};
}

bool BoardCommands::step(CommandLink& link, DeployLink& files, const std::string& plant, const std::string& busy,
                         rt::MonoTime now) {
  bool any = false;
  for (const Command& command : link.take_commands()) {
    if (command.board == board_ && command.agent == self_) {
      receive(link, command, plant, busy, now);
      any = true;
    }
  }
  if (!command_) {
    return any;
  }
  if (const auto done = poll(files, now)) {
    if (!is_recording(command_->action)) {  // the recorder reports its own actions
      send_reply(*done);
    }
    (void)note_command(*command_, user_, outcome_of(*done));  // its begin is noted
    known_[command_->commander].last = done;
    link.send(*done);
    command_.reset();
    run_.reset();
  }
  return any;
}

void BoardCommands::send_reply(const CommandReply& done) const {
  const std::string module = words_.lines.empty() ? "" : words_.lines.front();
  log_.info("command from {}: {} {}: {}", by(*command_, words_), word_of(command_->action),
            module.empty() ? "the node" : "module " + module, done.outcome == Outcome::Failed ? done.text : "done");
  if (done.outcome == Outcome::Done) {
    operate::note(board_, {rt::now_ns(),
                           0,
                           user_of(words_),
                           command_->host,
                           word_of(command_->action),
                           module.empty() ? "@" + board_ : module,
                           {},
                           0,
                           words_.reason});
  }
}

void BoardCommands::receive(CommandLink& link, const Command& command, const std::string& plant,
                            const std::string& busy, rt::MonoTime now) {
  std::erase_if(known_, [&](const auto& entry) {
    const bool under_way = command_ && command_->commander == entry.first;
    return now - entry.second.given > kNonce && !under_way;
  });
  auto found = known_.find(command.commander);
  const bool fresh = found == known_.end() || command.nonce != found->second.nonce;
  if (fresh) {
    if (found == known_.end() && known_.size() >= kMaxCommanders) {
      return;  // a client floods the agent; numbers expire, and then there is space again
    }
    Known& known = known_[command.commander];
    // A number that is not used yet is issued again: the first answer may have been lost.
    if (known.nonce == 0 || known.last) {
      known = {new_nonce(), now, std::nullopt};
    }
    CommandReply answer = reply(command, Outcome::Nonce);
    answer.nonce = known.nonce;
    link.send(answer);
    return;
  }
  Known& known = found->second;
  if (!known.last) {
    known.last = begin(command, plant, busy, now);
  }
  link.send(*known.last);
}

// A name in the command counts only if no certificate has another one.
CommandReply BoardCommands::begin(Command command, const std::string& plant, const std::string& busy,
                                  rt::MonoTime now) {
  if (command.action == Action::SetTrust) {
    return take_trust(command, plant, now);
  }
  const BoardUsers::Verdict verdict = users_.judge(command, plant);
  return carry_out(signed_by(std::move(command), verdict.user), plant, verdict, busy, now);
}

CommandReply BoardCommands::refuse(const Command& command, const std::string& user, const std::string& why,
                                   rt::MonoTime now) {
  if (const std::uint64_t count = refusals_.count(now.time_since_epoch().count()); count > 0) {
    const std::string noted = count > 1 ? fmt::format("{} ({} refusals)", why, count) : why;
    log_.warning("a command from {} was refused: {}", command.host, noted);
    (void)note_command(command, user, noted);  // nothing is changed, so a missing entry hides nothing
  }
  return reply(command, Outcome::Refused, why);
}

// Whatever the board is doing: what is revoked must not be valid any longer.
CommandReply BoardCommands::take_trust(const Command& command, const std::string& plant, rt::MonoTime now) {
  const auto taken = take_trust_list(board_, keys_, plant, command.host, command.target);
  if (!taken) {
    return refuse(command, "a participant with keys", taken.error().text, now);
  }
  if (taken->empty()) {
    return reply(command, Outcome::Unchanged);
  }
  log_.info("command from {}: {}", command.host, *taken);
  return reply(command, Outcome::Done);
}

CommandReply BoardCommands::carry_out(const Command& command, const std::string& plant,
                                      const BoardUsers::Verdict& verdict, const std::string& busy, rt::MonoTime now) {
  std::string why = verdict.refusal;
  if (why.empty() && (plant.empty() || command.plant != plant)) {
    why = plant.empty() ? "nothing is deployed to it" : fmt::format("it runs plant {} now", plant);
  }
  const auto order = command.action == Action::Force ? parse_write_order(command.target) : std::nullopt;
  if (why.empty() && order && order->renew) {
    return write(command, verdict.user);  // changes nothing and waits for nothing
  }
  if (why.empty()) {
    why = busy.empty() && command_ ? fmt::format("it is carrying out a command from {}; try again", command_->host)
                                   : busy;
  }
  if (!why.empty()) {
    return refuse(command, verdict.user, why, now);
  }
  if (const std::string unlogged = is_recording(command.action) ? "" : note_command(command, verdict.user, "begun");
      !unlogged.empty()) {
    const bool stop = is_stop(command.action);
    log_.warning("a command from {} {} it cannot be logged in {}", command.host,
                 stop ? "is a stop and carried out, although" : "was refused, because", unlogged);
    if (!stop) {
      return reply(command, Outcome::Refused,
                   fmt::format("nothing was changed, because it cannot be logged in {}", unlogged));
    }
  }
  deadline_ = now + kPatience;
  WriteOrder words = parse_module_target(command.target);
  CommandReply answer = perform(command, verdict.user, words, now);
  if (answer.outcome == Outcome::UnderWay) {
    command_ = command;
    words_ = std::move(words);
    user_ = verdict.user;
  } else {
    run_.reset();
    (void)note_command(command, verdict.user, outcome_of(answer));
  }
  return answer;
}

CommandReply BoardCommands::perform(const Command& command, const std::string& user, const WriteOrder& words,
                                    rt::MonoTime now) {
  if (is_write(command.action)) {
    return write(command, user);
  }
  if (command.action == Action::KeepBox) {
    return keep_box(command);
  }
  if (command.action == Action::SetUsers) {
    const auto replaced = users_.replace(command.plant, command.target);
    return replaced ? reply(command, Outcome::Done) : reply(command, Outcome::Refused, replaced.error().text);
  }
  if (is_about_alarms(command.action)) {
    return about_alarms(command);
  }
  if (is_recording(command.action)) {
    return begin_recording(command, now);
  }
  return is_about_node(command.action) ? begin_node(command, words) : begin_module(command, words, now);
}

bool BoardCommands::open_run() {
  run_ = open_running_node(board_);
  return run_.has_value();
}

scheduler::ModuleRecord* BoardCommands::find(const std::string& module) {
  return find_module_record(run_block(*run_), module);
}

CommandReply BoardCommands::write(const Command& command, const std::string& user) {
  if (process_.condition() != NodeCondition::Running) {
    return reply(command, Outcome::Refused, "its node is not running");
  }
  const auto order = parse_write_order(command.target);
  const auto done = forces_.carry_out(command, user);
  if (!order || !order->renew) {
    const std::string what = !order                 ? command.target
                             : order->lines.empty() ? "*"
                                                    : fmt::format("{}", fmt::join(order->lines, " "));
    log_.info("command from {}: {} {}: {}", command.host, word_of(command.action), one_line(what),
              done ? "done" : done.error().text);
  }
  return done ? reply(command, Outcome::Done) : reply(command, Outcome::Refused, done.error().text);
}

// The node writes the box shortly after: only it has all the data of its runs.
CommandReply BoardCommands::keep_box(const Command& command) const {
  if (process_.condition() != NodeCondition::Running) {
    return reply(command, Outcome::Refused, "its node is not running");
  }
  const std::string why = one_line(command.target);
  const Status requested = vars::request_box(board_, why);
  log_.info("command from {}: {} {}: {}", command.host, word_of(command.action), why,
            requested ? "done" : requested.error().where);
  return requested ? reply(command, Outcome::Done) : reply(command, Outcome::Failed, requested.error().where);
}

CommandReply BoardCommands::about_alarms(const Command& command) const {
  const auto done = order_alarms(board_, command);
  log_.info("command from {}: {}: {}", command.host, word_of(command.action),
            done ? one_line(*done) : done.error().text);
  return done ? reply(command, Outcome::Done, *done) : reply(command, Outcome::Refused, done.error().text);
}

CommandReply BoardCommands::begin_recording(const Command& command, rt::MonoTime now) {
  if (command.action == Action::Record && process_.condition() != NodeCondition::Running) {
    return reply(command, Outcome::Refused, "its node is not running");
  }
  const BoardRecorder::Answer answer = recorder_.begin(command, now);
  return reply(command, answer.outcome, answer.text);
}

std::optional<CommandReply> BoardCommands::poll_recording() {
  const auto answer = recorder_.poll(command_->action);
  return answer ? std::optional(reply(*command_, answer->outcome, answer->text)) : std::nullopt;
}

CommandReply BoardCommands::begin_module(const Command& command, const WriteOrder& words, rt::MonoTime now) {
  const std::string name = words.lines.empty() ? "" : words.lines.front();
  if (process_.condition() != NodeCondition::Running || !open_run()) {
    return reply(command, Outcome::Refused, "its node is not running");
  }
  if (const std::string why = locked_against_commands(board_); !why.empty()) {
    return reply(command, Outcome::Refused, why);
  }
  module_ = find(name);
  if (module_ == nullptr) {
    std::string names;
    auto& block = run_block(*run_);
    for (std::uint32_t i = 0; i < block.module_count; ++i) {
      names += (i > 0 ? ", " : "") + std::string(block.modules()[i].name);
    }
    return reply(command, Outcome::Refused,
                 names.empty() ? fmt::format("it has no module {}, nor any other", name)
                               : fmt::format("it has no module {}; it has {}", name, names));
  }
  if (command.action != Action::StopModule) {
    if (const std::string damage = process_.verify(); !damage.empty()) {
      return reply(command, Outcome::Refused, "its files are not what was deployed: " + damage);
    }
  }
  if (command.action == Action::ReloadModule) {
    return begin_reload(command, words, now);
  }
  const auto ticket = scheduler::place_command(*module_, module_command_of(command.action));
  if (!ticket) {
    return reply(command, Outcome::Refused, "an earlier command about this module is not done yet; try again");
  }
  ticket_ = *ticket;
  return reply(command, Outcome::UnderWay);
}

CommandReply BoardCommands::begin_reload(const Command& command, const WriteOrder& words, rt::MonoTime now) {
  const std::string why =
      reload_.begin(command.commander, words.lines.size() == 2 ? words.lines.back() : std::string(), *module_);
  deadline_ = now + reload_.patience();
  return why.empty() ? reply(command, Outcome::UnderWay) : reply(command, Outcome::Refused, why);
}

std::optional<CommandReply> BoardCommands::poll_reload(DeployLink& files, rt::MonoTime now) {
  const bool ended = process_.condition() != NodeCondition::Running;
  const auto answer =
      ended ? std::optional(BoardReload::Answer{Outcome::Failed, "the node has ended"}) : reload_.poll(files, now);
  if (ended || (!answer && now > deadline_)) {
    reload_.cancel();
  }
  return answer ? std::optional(reply(*command_, answer->outcome, answer->text)) : std::nullopt;
}

CommandReply BoardCommands::begin_node(const Command& command, const WriteOrder& words) {
  const NodeCommand::Answer answer = node_.begin(command.action, by(command, words));
  return reply(command, answer.outcome, answer.text);
}

std::optional<CommandReply> BoardCommands::poll(DeployLink& files, rt::MonoTime now) {
  std::optional<CommandReply> done;
  if (command_->action == Action::ReloadModule) {
    done = poll_reload(files, now);
  } else if (is_recording(command_->action)) {
    done = poll_recording();
  } else {
    done = is_about_node(command_->action) ? poll_node() : poll_module();
  }
  if (!done && now > deadline_) {
    done = reply(*command_, Outcome::Failed, "not done in time; it continues");
  }
  return done;
}

std::optional<CommandReply> BoardCommands::poll_module() {
  switch (scheduler::result_of(*module_, ticket_)) {
    case CommandResult::Done:
      return reply(*command_, Outcome::Done);
    case CommandResult::OldCode:
      return reply(*command_, Outcome::Done, "its file was replaced, the code that was loaded before is running");
    case CommandResult::Unchanged:
      return reply(*command_, Outcome::Unchanged);
    case CommandResult::Refused:
    case CommandResult::Failed:
      return reply(*command_, Outcome::Failed,
                   module_->last_fault[0] != '\0' ? module_->last_fault : "it could not be started");
    case CommandResult::Ending:
      return reply(*command_, Outcome::Failed, "the node ends");
    case CommandResult::None:
      break;
  }
  return process_.condition() == NodeCondition::Running
             ? std::nullopt
             : std::optional(reply(*command_, Outcome::Failed, "the node has ended"));
}

std::optional<CommandReply> BoardCommands::poll_node() {
  const auto answer = node_.poll(command_->action);
  return answer ? std::optional(reply(*command_, answer->outcome, answer->text)) : std::nullopt;
}

}  // namespace indurop::deploy
