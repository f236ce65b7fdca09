// SPDX-License-Identifier: Apache-2.0
// Which user may give which command to this board. Deployers may give all. Others sign with the key of a certificate
// that the plant's authority issued to them; their name in it, not the name in the command, is found in the list of
// users that a deployer or an administrator sent to the board, with role and limits. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "config/model/users.h"
#include "core/base/problem.h"
#include "core/keys/credentials.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/transaction/user_list.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

// Returns the role that a command needs.
config::UserRole needed_role(Action action) noexcept;

// The authority of a plant, by which the certificates of users are verified.
struct Authority {
  std::string plant;
  std::string certificate;
};
// Returns the user who signed the text, or why the signature does not count. That the certificate is not revoked is
// left to the caller.
Result<std::string, base::Problem> signer_of(const std::string& text, const UserSignature& signature,
                                             const Authority& authority, keys::Instant now);

// Returns why the user may not give such a command to the board; empty: the role suffices, and the board is one of the
// user's. `users`: the list.
std::string beyond_role(const config::PlantUsers& users, const std::string& name, Action action,
                        const std::string& board);
// Returns why the user may not change the variable or a part of it; empty: allowed.
std::string beyond_variables(const config::PlantUser& user, const std::string& name);

class BoardUsers {
 public:
  BoardUsers(std::string board, const DeployKeys& keys);

  struct Verdict {
    std::string user;     // verified name; empty: the command is that of a deployer, or the board has no keys
    std::string refusal;  // empty: allowed
  };
  // Judges a command to this board, which runs `plant`.
  [[nodiscard]] Verdict judge(const Command& command, const std::string& plant) const;

  // Returns which list of users of the plant this board has, as the text of a UserListId; empty: none.
  [[nodiscard]] std::string id(const std::string& plant) const;
  // Returns the text of the list if it is newer than that with this id; empty: the board has none, or no newer one.
  [[nodiscard]] std::string newer_than(const std::string& plant, const std::string& id) const;
  // Replaces the list of users of the plant by a newer one, durably. A problem: it is no list, not signed by a deployer
  // or an administrator of the list that it replaces, or not newer.
  Result<void, base::Problem> replace(const std::string& plant, const std::string& text) const;
  // Does the same with the list of another board, and logs it. Returns what was done, for people.
  Result<std::string, base::Problem> take(const std::string& plant, const std::string& text) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& plant) const;
  [[nodiscard]] std::optional<UserList> stored(const std::string& plant) const;
  [[nodiscard]] config::PlantUsers users_of(const std::string& plant) const;
  // Judges a signature alone: whose it is, and whether it counts for the plant.
  [[nodiscard]] Verdict signer(const std::string& plant, const std::string& text, const std::string& signature) const;
  // Judges whether the signature of a list suffices to replace the board's own.
  [[nodiscard]] Verdict author_of(const UserList& list) const;
  struct Accepted {
    UserList list;
    std::string author;
  };
  [[nodiscard]] Result<Accepted, base::Problem> accept(const std::string& plant, const std::string& text) const;
  [[nodiscard]] Result<void, base::Problem> store(const UserList& list) const;
  [[nodiscard]] std::string beyond_limits(const config::PlantUser& user, const Command& command) const;

  std::string board_;
  const DeployKeys& keys_;
};

}  // namespace indurop::deploy
