// SPDX-License-Identifier: Apache-2.0
// The users of --users: who they are by session or token, and their sessions. The file is read again when it has
// changed, so a user who was removed, or has lost a role, is so from the next request on. Thread-safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/model/users.h"
#include "tools/serve/door/access_gate.h"

namespace indurop::serve {

struct SessionFigures {
  std::string user;
  std::string from;  // address
  std::int64_t since_ns = 0;
  std::int64_t used_ns = 0;  // last request
};

class UserBook final : public Accounts {
 public:
  static constexpr std::int64_t kIdleNs = std::int64_t{30} * 60 * 1'000'000'000;       // a session ends after that
  static constexpr std::int64_t kLongestNs = std::int64_t{12} * 3600 * 1'000'000'000;  // and after that in any case
  static constexpr std::size_t kMostSessions = 256;

  // Without a file there are no users.
  UserBook() = default;
  // `now_ns`: a monotonic clock.
  UserBook(std::filesystem::path file, std::int64_t (*now_ns)()) : file_(std::move(file)), now_ns_(now_ns) {}

  [[nodiscard]] bool used() const noexcept { return !file_.empty(); }
  // Returns why the file cannot be used, with places; empty: it can.
  std::string problem();

  std::optional<Client> client_of_token(std::string_view token, bool use = true) override;
  // Returns what the list says of the user with this name; nothing: the list does not name it.
  std::optional<Client> client_named(std::string_view name);
  // Returns the client that a certificate names, with the role and limits of the list; if the list does not name it,
  // with the role `unlisted`. While the list cannot be used, the client is refused: the list may grant less than the
  // certificate does.
  Client client_certified(Client client, Role unlisted);

  // Verifies the password, which takes some 0.1 s whether there is such a user or not. Returns the token of a new
  // session, or nothing. The session that was used the longest time ago ends if there are too many.
  std::optional<std::string> sign_in(const std::string& name, const std::string& password, const std::string& from);
  // Ends the session of this token. Returns false if it has none.
  bool sign_out(std::string_view token);
  // Ends all sessions of a user. Returns their number.
  std::size_t end_sessions(std::string_view user);

  std::vector<config::PlantUser> users();
  std::vector<SessionFigures> sessions();

 private:
  struct Session {
    SessionFigures figures;
    std::string password;  // hash: a session ends when the password is changed
  };
  // What tells that the file has changed, once it is settled. All 0: it is not there.
  struct Version {
    std::int64_t changed_ns = 0;
    std::uint64_t number = 0;  // inode
    std::uint64_t size = 0;
    bool operator==(const Version&) const = default;
  };

  void refresh();
  void end_old(std::int64_t now_ns);
  [[nodiscard]] static Client client_of(const config::PlantUser& user);

  std::filesystem::path file_;
  std::int64_t (*now_ns_)() = nullptr;
  std::mutex lock_;
  std::optional<Version> version_;  // nothing: it is read for each request
  std::string problem_;
  config::PlantUsers users_;
  std::map<std::string, Session, std::less<>> sessions_;  // by hash of the token
};

}  // namespace indurop::serve
