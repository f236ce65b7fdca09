// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_users.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "config/users_reader.h"
#include "core/base/name_patterns.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/keys/participant_keys.h"
#include "core/keys/plant_keys.h"
#include "deploy/transaction/write_words.h"
#include "store/operate/item.h"
#include "store/vars/retain.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Problem;
using config::UserRole;

constexpr mode_t kListMode = 0640;

std::string text_of_file(const fs::path& file) {
  auto text = base::read_file(file);
  return text ? std::move(*text) : std::string{};
}

bool is_about_variables(Action action) noexcept {
  return action == Action::Set || action == Action::Force || action == Action::Unforce;
}

// Returns the full names of what the command changes; nothing if that is not known, or is all.
Result<std::vector<std::string>, Problem> names_in(const std::string& board, const Command& command) {
  const auto order = parse_write_order(command.target);
  const auto store = vars::Store::attach(board, vars::Mode::ReadOnly);
  if (!order || !store || order->lines.empty()) {
    return Problem{"what it would change is not known"};
  }
  std::vector<std::string> names;
  for (const std::string& line : order->lines) {
    names.push_back(line.substr(0, command.action == Action::Unforce ? line.size() : line.find('=')));
  }
  const auto items = operate::select(*store, names);
  if (!items) {
    return Problem{fmt::format("{}", fmt::join(items.error(), "; "))};
  }
  names.clear();
  std::transform(items->begin(), items->end(), std::back_inserter(names), [](const auto& item) { return item.name; });
  return names;
}

}  // namespace

UserRole needed_role(Action action) noexcept {
  switch (action) {
    case Action::Set:
    case Action::AckAlarms:
    case Action::KeepBox:
    case Action::Record:
    case Action::EndRecord:
    case Action::DropRecord:
      return UserRole::Operate;
    case Action::Force:
    case Action::Unforce:
    case Action::ShelveAlarms:
    case Action::UnshelveAlarms:
      return UserRole::Tune;
    case Action::StopModule:
    case Action::StartModule:
    case Action::RestartModule:
    case Action::StopNode:
    case Action::StartNode:
    case Action::RestartNode:
    case Action::SetLock:
      return UserRole::Program;
    case Action::SetUsers:
    case Action::ReloadModule:  // beyond_role() refuses it to all users
      break;
  }
  return UserRole::Administer;
}

Result<std::string, Problem> signer_of(const Command& command, const UserSignature& signature,
                                       const Authority& authority, keys::Instant now) {
  const auto facts = keys::read_certificate(signature.certificate);
  if (!facts || !keys::issued_by(signature.certificate, authority.certificate) ||
      facts->organisation != authority.plant) {
    return Problem{fmt::format("its certificate was not issued by the authority of plant {}", authority.plant)};
  }
  const std::string& name = facts->common_name;
  if (keys::plant_role(*facts) != keys::Role::User) {
    return Problem{fmt::format("{} has no certificate of a user; indurop keys add --user NAME makes one", name)};
  }
  if (keys::is_revoked(signature.certificate, authority.revoked)) {
    return Problem{fmt::format("the keys of {} are revoked", name)};
  }
  if (now < facts->validity.from || now > facts->validity.until) {
    return Problem{fmt::format("the certificate of {} is not valid now", name)};
  }
  if (!keys::signature_holds(command_text(command), signature.signature, keys::public_key_in(signature.certificate))) {
    return Problem{fmt::format("it is not signed with the key of {}", name)};
  }
  return name;
}

std::string beyond_role(const config::PlantUsers& users, const std::string& name, Action action,
                        const std::string& board) {
  const config::PlantUser* user = users.find(name);
  if (user == nullptr) {
    return fmt::format("{} is not in this board's list of users; indurop users send brings it", name);
  }
  if (action == Action::ReloadModule) {
    return fmt::format("{} cannot bring code to a board; deployers do that, as for deployments", name);
  }
  if (user->role < needed_role(action)) {
    return fmt::format("{} has the role {}, and this needs {}", name, config::name_of(user->role),
                       config::name_of(needed_role(action)));
  }
  if (!base::matches_any(user->boards, board)) {
    return fmt::format("{} may change boards {} only", name, fmt::join(user->boards, ", "));
  }
  return {};
}

std::string beyond_variables(const config::PlantUser& user, const std::string& name) {
  return base::matches_any_variable(user.variables, name)
             ? std::string()
             : fmt::format("{} may change {} only, not {}", user.name, fmt::join(user.variables, ", "), name);
}

BoardUsers::BoardUsers(std::string board, const DeployKeys& keys) : board_(std::move(board)), keys_(keys) {}

fs::path BoardUsers::file_of(const std::string& plant) const {
  return vars::state_directory(board_) / "users" / (plant + ".xml");
}

// A user who is limited to some variables can change nothing else.
std::string BoardUsers::beyond_limits(const config::PlantUser& user, const Command& command) const {
  const auto order = parse_write_order(command.target);
  if (user.variables.empty() || (command.action == Action::Force && order && order->renew)) {
    return {};  // a renewal extends what was allowed
  }
  const auto names =
      is_about_variables(command.action) ? names_in(board_, command) : Problem{"this changes more than variables"};
  if (!names) {
    return fmt::format("{} may change {} only: {}", user.name, fmt::join(user.variables, ", "), names.error().text);
  }
  for (const std::string& name : *names) {
    if (std::string beyond = beyond_variables(user, name); !beyond.empty()) {
      return beyond;
    }
  }
  return {};
}

BoardUsers::Verdict BoardUsers::judge(const Command& command, const std::string& plant) const {
  const auto signature = read_user_signature(command.signature);
  const OwnKeys own = keys_.own(plant);
  if (!signature || own.folder.empty()) {
    return {{}, keys_.refusal(plant, command_text(command), command.signature)};
  }
  const keys::ParticipantKeys files(own.folder);
  const auto name =
      signer_of(command, *signature, {own.plant, text_of_file(files.authority), text_of_file(files.revoked)},
                keys::instant_now());
  if (!name) {
    return {{}, name.error().text};
  }
  if (own.plant != plant) {
    return {*name, fmt::format("this board has keys, but none of plant {}", plant)};
  }
  const config::ReadUsers list = config::read_users(file_of(plant));
  const config::PlantUsers users = list.ok() ? list.users : config::PlantUsers{};
  std::string refusal = beyond_role(users, *name, command.action, board_);
  if (refusal.empty()) {
    refusal = beyond_limits(*users.find(*name), command);
  }
  return {*name, std::move(refusal)};
}

Result<void, Problem> BoardUsers::replace(const std::string& plant, const std::string& list) const {
  if (!vars::valid_node_name(plant) || !config::read_users_text(list, "users.xml").ok()) {
    return Problem{"it is not a list of users"};
  }
  const fs::path file = file_of(plant);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const auto written = base::replace_file(file, list, base::Durable::Yes, kListMode);
  return written ? Result<void, Problem>() : Problem{base::cannot_write(file, written.error())};
}

}  // namespace indurop::deploy
