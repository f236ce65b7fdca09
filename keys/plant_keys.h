// SPDX-License-Identifier: Apache-2.0
// A plant's keys as a folder (docs/security.md): the authority in it, and one folder for each board and for the other
// participants, which is all that they need. Private keys are readable by their owner only and never replaced.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"
#include "keys/credentials.h"
#include "keys/dds_documents.h"

namespace indurop::keys {

// What one participant shows to the others, and what it judges them by.
struct ParticipantKeys {
  explicit ParticipantKeys(const std::filesystem::path& in);
  std::filesystem::path folder;
  std::filesystem::path authority;
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::filesystem::path governance;
  std::filesystem::path permissions;
  std::filesystem::path revoked;     // certificates that are not valid any more
  std::filesystem::path deploy_key;  // public half of what signs deployments
};

struct KeyListing {
  Role role = Role::Board;
  std::string name;
  std::filesystem::path folder;
  Validity validity;
  bool revoked = false;
  std::string problem;  // empty: it can be used
};

class PlantKeys {
 public:
  explicit PlantKeys(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // A call with a problem has changed nothing.
  Result<void, base::Problem> make(const std::string& plant, const std::vector<std::string>& boards,
                                   Instant until) const;
  Result<void, base::Problem> add(const std::string& board, Instant until) const;
  // A new certificate and new permissions for the old key.
  Result<void, base::Problem> renew(const KeyListing& whose, Instant until) const;
  // The certificate counts no more for participants that have the new list, which is put into all folders.
  Result<void, base::Problem> revoke(const KeyListing& whose) const;

  [[nodiscard]] bool exist() const;
  [[nodiscard]] std::string plant() const;  // empty: there is no authority that can be read
  [[nodiscard]] std::vector<KeyListing> list(Instant now) const;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path board(const std::string& name) const { return folder_ / "boards" / name; }
  [[nodiscard]] std::filesystem::path viewer() const { return folder_ / "viewer"; }
  [[nodiscard]] std::filesystem::path deployer() const { return folder_ / "deployer"; }

 private:
  std::filesystem::path folder_;
};

// What is wrong with the keys in a folder; `why` says what kind.
enum class KeyFault { None, Missing, Wrong, NotNow };
struct KeyCheck {
  KeyFault fault = KeyFault::None;
  std::string problem;
  Validity validity;
  std::string authority;  // its certificate; empty after Missing
};
// As those of a board of the plant at this time.
KeyCheck check_board_keys(const std::filesystem::path& folder, const std::string& plant, const std::string& board,
                          Instant now);

// From when all certificates count. Long ago, so that a board that lost its time at power-off is not kept out.
Instant valid_from();
Instant instant_now();

}  // namespace indurop::keys
