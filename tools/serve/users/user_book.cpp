// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/users/user_book.h"

#include <sys/stat.h>

#include <algorithm>

#include "config/users_reader.h"
#include "core/keys/password.h"
#include "core/rt/clock.h"
#include "tools/client/process/random_word.h"

namespace indurop::serve {
namespace {

Role role_of(config::UserRole role) noexcept {
  switch (role) {
    case config::UserRole::Look:
      return Role::Look;
    case config::UserRole::Operate:
      return Role::Operate;
    case config::UserRole::Tune:
      return Role::Tune;
    case config::UserRole::Program:
      return Role::Program;
    case config::UserRole::Administer:
      return Role::Administer;
  }
  return Role::Unknown;
}

// Of a user who does not exist: the time that a refusal takes reveals nothing.
const std::string& hash_of_no_user() {
  static const std::string kHash = keys::hash_of_password(tools::random_word());
  return kHash;
}

}  // namespace

Client UserBook::client_of(const config::PlantUser& user) {
  return {user.name, role_of(user.role), {}, user.boards, user.variables};
}

// While the file cannot be read, or is wrong, it names no one: sessions do not outlive their users.
void UserBook::refresh() {
  struct stat found {};
  Version version;
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  if (::stat(file_.c_str(), &found) == 0) {
    // Not the time of the content, which a user can set: a list that was restored may have that of another one.
    version = {found.st_ctim.tv_sec * kSecondNs + found.st_ctim.tv_nsec, found.st_ino,
               static_cast<std::uint64_t>(found.st_size)};
  }
  if (version_ == version && problem_.empty()) {
    return;
  }
  // The clock of file systems is coarse: the next change of a file that has just changed may leave its time as it is.
  const bool settled = version.changed_ns + kSecondNs < rt::wall_ns();
  version_ = settled ? std::optional(version) : std::nullopt;
  config::ReadUsers read = config::read_users(file_);
  problem_ = read.ok() ? std::string() : base::to_text(read.diagnostics);
  users_ = read.ok() ? std::move(read.users) : config::PlantUsers{};
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    problem_ = file_.string() + ": error: users other than its owner can change it; chmod go-w it\n";
    users_ = {};
  }
}

std::string UserBook::problem() {
  const std::lock_guard guard(lock_);
  refresh();
  return problem_;
}

void UserBook::end_old(std::int64_t now_ns) {
  std::erase_if(sessions_, [&](const auto& one) {
    const SessionFigures& session = one.second.figures;
    const config::PlantUser* const user = users_.find(session.user);
    return user == nullptr || user->password != one.second.password || now_ns - session.used_ns > kIdleNs ||
           now_ns - session.since_ns > kLongestNs;
  });
}

// A token is looked for by its hash: the time of a comparison of hashes reveals nothing about tokens.
std::optional<Client> UserBook::client_of_token(std::string_view token, bool use) {
  if (!used()) {
    return std::nullopt;
  }
  const std::string hash = keys::hash_of_token(token);
  const std::lock_guard guard(lock_);
  refresh();
  const std::int64_t now = now_ns_();
  end_old(now);
  if (const auto session = sessions_.find(hash); session != sessions_.end()) {
    session->second.figures.used_ns = use ? now : session->second.figures.used_ns;
    return client_of(*users_.find(session->second.figures.user));
  }
  const auto user = std::find_if(users_.users.begin(), users_.users.end(),
                                 [&hash](const config::PlantUser& one) { return one.token == hash; });
  return user != users_.users.end() ? std::optional(client_of(*user)) : std::nullopt;
}

std::optional<Client> UserBook::client_named(std::string_view name) {
  if (!used()) {
    return std::nullopt;
  }
  const std::lock_guard guard(lock_);
  refresh();
  const config::PlantUser* const user = users_.find(name);
  return user != nullptr ? std::optional(client_of(*user)) : std::nullopt;
}

Client UserBook::client_certified(Client client, Role unlisted) {
  if (!used()) {
    return client;
  }
  const std::lock_guard guard(lock_);
  refresh();
  if (!problem_.empty()) {
    return {
        client.name, Role::Unknown, "the list of users cannot be used, so no certificate of a person counts", {}, {}};
  }
  const config::PlantUser* const user = users_.find(client.name);
  client.role = unlisted;
  return user != nullptr ? client_of(*user) : std::move(client);
}

std::optional<std::string> UserBook::sign_in(const std::string& name, const std::string& password,
                                             const std::string& from) {
  std::string hash;
  {
    const std::lock_guard guard(lock_);
    refresh();
    const config::PlantUser* const user = users_.find(name);
    hash = user != nullptr ? user->password : std::string();
  }
  // Without the lock: requests of others do not wait for it.
  const bool right = keys::is_password(password, hash.empty() ? hash_of_no_user() : hash);
  if (!right || hash.empty()) {
    return std::nullopt;
  }
  std::string token = tools::random_word();
  if (token.empty()) {
    return std::nullopt;
  }
  const std::lock_guard guard(lock_);
  const std::int64_t now = now_ns_();
  end_old(now);
  if (sessions_.size() >= kMostSessions) {
    sessions_.erase(std::min_element(sessions_.begin(), sessions_.end(), [](const auto& a, const auto& b) {
      return a.second.figures.used_ns < b.second.figures.used_ns;
    }));
  }
  sessions_.emplace(keys::hash_of_token(token), Session{{name, from, now, now}, hash});
  return token;
}

bool UserBook::sign_out(std::string_view token) {
  const std::lock_guard guard(lock_);
  return sessions_.erase(keys::hash_of_token(token)) > 0;
}

std::size_t UserBook::end_sessions(std::string_view user) {
  const std::lock_guard guard(lock_);
  return std::erase_if(sessions_, [user](const auto& one) { return one.second.figures.user == user; });
}

std::vector<config::PlantUser> UserBook::users() {
  const std::lock_guard guard(lock_);
  refresh();
  return users_.users;
}

std::vector<SessionFigures> UserBook::sessions() {
  const std::lock_guard guard(lock_);
  refresh();
  end_old(now_ns_());
  std::vector<SessionFigures> all;
  for (const auto& [hash, session] : sessions_) {
    all.push_back(session.figures);
  }
  return all;
}

}  // namespace indurop::serve
