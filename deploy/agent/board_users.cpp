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
#include "deploy/agent/board_audit.h"
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
// A list may skip so many serials, which are seconds since 1970 (next_serial): an administrator cannot use up all of
// them.
constexpr std::uint64_t kMostSteps = 1ULL << 32U;

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
    case Action::SetTrust:      // signed by the authority instead
    case Action::ReloadModule:  // beyond_role() refuses it to all users
      break;
  }
  return UserRole::Administer;
}

Result<std::string, Problem> signer_of(const std::string& text, const UserSignature& signature,
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
  if (now < facts->validity.from || now > facts->validity.until) {
    return Problem{fmt::format("the certificate of {} is not valid now", name)};
  }
  if (!keys::signature_holds(text, signature.signature, keys::public_key_in(signature.certificate))) {
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
  return vars::state_directory(board_) / "users" / (plant + ".list");
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

BoardUsers::Verdict BoardUsers::signer(const std::string& plant, const std::string& text,
                                       const std::string& signature) const {
  const auto of_user = read_user_signature(signature);
  const OwnKeys own = keys_.own(plant);
  if (!of_user || own.folder.empty()) {
    return {{}, keys_.refusal(plant, text, signature)};
  }
  const std::string authority = text_of_file(keys::ParticipantKeys(own.folder).authority);
  const auto name = signer_of(text, *of_user, {own.plant, authority}, keys::instant_now());
  if (!name) {
    return {{}, name.error().text};
  }
  if (keys_.trust(own.plant).revokes(of_user->certificate)) {
    return {{}, fmt::format("the keys of {} are revoked", *name)};
  }
  return {*name, own.plant == plant ? "" : fmt::format("this board has keys, but none of plant {}", plant)};
}

std::optional<UserList> BoardUsers::stored(const std::string& plant) const {
  return read_user_list(text_of_file(file_of(plant)));
}

config::PlantUsers BoardUsers::users_of(const std::string& plant) const {
  const auto list = stored(plant);
  config::ReadUsers read = config::read_users_text(list ? list->users : std::string(), file_of(plant));
  return read.ok() ? std::move(read.users) : config::PlantUsers{};
}

BoardUsers::Verdict BoardUsers::judge(const Command& command, const std::string& plant) const {
  Verdict verdict = signer(plant, command_text(command), command.signature);
  if (verdict.refusal.empty() && !verdict.user.empty()) {
    const config::PlantUsers users = users_of(plant);
    verdict.refusal = beyond_role(users, verdict.user, command.action, board_);
    if (verdict.refusal.empty()) {
      verdict.refusal = beyond_limits(*users.find(verdict.user), command);
    }
  }
  return verdict;
}

std::string BoardUsers::id(const std::string& plant) const {
  const auto list = stored(plant);
  return list ? text_of(id_of(*list)) : std::string();
}

std::string BoardUsers::newer_than(const std::string& plant, const std::string& id) const {
  const auto own = stored(plant);
  const auto other = read_user_list_id(id);
  return own && (!other || *other < id_of(*own)) ? text_of(*own) : std::string();
}

BoardUsers::Verdict BoardUsers::author_of(const UserList& list) const {
  Verdict verdict = signer(list.plant, signed_text(list), list.signature);
  if (verdict.refusal.empty() && !verdict.user.empty()) {
    const config::PlantUsers users = users_of(list.plant);
    verdict.refusal = beyond_role(users, verdict.user, Action::SetUsers, board_);
    if (verdict.refusal.empty() && !users.find(verdict.user)->variables.empty()) {
      verdict.refusal = fmt::format("{} may change some variables only", verdict.user);
    }
  }
  return verdict;
}

Result<BoardUsers::Accepted, Problem> BoardUsers::accept(const std::string& plant, const std::string& text) const {
  auto list = read_user_list(text);
  if (!vars::valid_node_name(plant) || !list || list->plant != plant ||
      !config::read_users_text(list->users, "users.xml").ok()) {
    return Problem{"it is not a list of users of this plant, or one of another release"};
  }
  Verdict author = author_of(*list);
  if (!author.refusal.empty()) {
    return Problem{std::move(author.refusal)};
  }
  const UserListId own = id_of(stored(plant).value_or(UserList{}));
  if (id_of(*list) < own || list->serial > own.serial + kMostSteps) {
    return Problem{fmt::format("this board has list {} of the users, and this one is {}; send the list again",
                               own.serial, list->serial)};
  }
  return Accepted{*std::move(list), std::move(author.user)};
}

Result<void, Problem> BoardUsers::store(const UserList& list) const {
  const fs::path file = file_of(list.plant);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const auto written = base::replace_file(file, text_of(list), base::Durable::Yes, kListMode);
  return written ? Result<void, Problem>() : Problem{base::cannot_write(file, written.error())};
}

Result<void, Problem> BoardUsers::replace(const std::string& plant, const std::string& text) const {
  const auto accepted = accept(plant, text);
  return accepted ? store(accepted->list) : accepted.error();
}

Result<std::string, Problem> BoardUsers::take(const std::string& plant, const std::string& text) const {
  const auto accepted = accept(plant, text);
  if (!accepted) {
    return accepted.error();
  }
  if (std::string unlogged = log_users(board_, accepted->list, accepted->author); !unlogged.empty()) {
    return Problem{fmt::format("it cannot be logged in {}", unlogged)};
  }
  if (const auto stored = store(accepted->list); !stored) {
    return stored.error();
  }
  return fmt::format("list {} of the users of {} comes from another board", accepted->list.serial, plant);
}

}  // namespace indurop::deploy
