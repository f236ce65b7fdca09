// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_audit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "core/rt/clock.h"
#include "deploy/agent/action_kinds.h"
#include "deploy/transaction/write_words.h"
#include "store/operate/audit.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxWhat = 400;

// The form of these targets is their own.
bool has_words(Action action) noexcept {
  return action != Action::KeepBox && action != Action::Record && action != Action::EndRecord &&
         action != Action::DropRecord && action != Action::SetUsers && action != Action::SetTrust;
}

std::string append(operate::AuditEntry entry) {
  const std::filesystem::path file = operate::usual_audit_file();
  const std::string problem = operate::append_audit(file, std::move(entry));
  return problem.empty() ? problem : fmt::format("{}: {}", file.string(), problem);
}

}  // namespace

const char* word_of(Action action) noexcept {
  switch (action) {
    case Action::StopModule:
    case Action::StopNode:
      return "stop";
    case Action::StartModule:
    case Action::StartNode:
      return "start";
    case Action::Force:
      return "force";
    case Action::Unforce:
      return "unforce";
    case Action::Set:
      return "set";
    case Action::SetLock:
      return "lock";
    case Action::KeepBox:
      return "keep the black box:";
    case Action::AckAlarms:
      return "acknowledge alarms";
    case Action::ShelveAlarms:
      return "shelve alarms";
    case Action::UnshelveAlarms:
      return "unshelve alarms";
    case Action::Record:
    case Action::EndRecord:
    case Action::DropRecord:
      return "record";
    case Action::SetUsers:
      return "set users";
    case Action::SetTrust:
      return "set valid keys";
    case Action::ReloadModule:
      return "reload";
    case Action::RestartModule:
    case Action::RestartNode:
      break;
  }
  return "restart";
}

Command signed_by(Command command, const std::string& user) {
  if (!user.empty() && has_words(command.action)) {
    WriteOrder order = parse_module_target(command.target);
    order.who = user;
    command.target = text_of(order);
  }
  return command;
}

std::string note_command(const Command& command, const std::string& user, const std::string& outcome) {
  if (is_recording(command.action) && outcome == "unchanged") {
    return {};  // repeated to keep it running
  }
  const WriteOrder order = has_words(command.action) ? parse_module_target(command.target) : WriteOrder{};
  const bool renewal = command.action == Action::Force && order.renew;
  const std::string claimed = order.who.empty() ? "a deployer" : order.who + " (deployer)";
  const std::string what = renewal ? "renewal" : fmt::format("{}", fmt::join(order.lines, " ")).substr(0, kMaxWhat);
  return append({rt::wall_ns(), user.empty() ? claimed : user, command.host, command.board, word_of(command.action),
                 what, outcome, order.reason});
}

std::string log_users(const std::string& board, const UserList& list, const std::string& author) {
  return append({rt::wall_ns(), author.empty() ? "a deployer" : author, "another board", board,
                 word_of(Action::SetUsers), fmt::format("list {}", list.serial), "done", ""});
}

std::string log_trust(const std::string& board, const std::string& plant, const std::string& from, std::uint64_t serial,
                      const std::string& outcome) {
  return append({rt::wall_ns(), fmt::format("the authority of {}", plant), from, board, word_of(Action::SetTrust),
                 fmt::format("list {}", serial), outcome, ""});
}

}  // namespace indurop::deploy
