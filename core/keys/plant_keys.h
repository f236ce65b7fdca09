// SPDX-License-Identifier: Apache-2.0
// The keys of a plant as a folder (docs/security.md): the authority, and one folder for each board and each other
// participant, with all that it needs. Private keys are readable by their owner only and never replaced.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/keys/credentials.h"
#include "core/keys/dds_documents.h"
#include "core/keys/participant_keys.h"

namespace indurop::keys {

struct KeyListing {
  Role role = Role::Board;
  std::string name;
  std::filesystem::path folder;
  Validity validity;
  bool revoked = false;
  std::string problem;       // empty: the keys can be used
  VariableRights variables;  // for Role::Tool
  std::string exposed;       // exposed_key() of its private keys
};

// Return true for the certificate of a plant's authority, and for one that such an authority has issued.
bool is_plant_authority(const CertificateFacts& facts);
bool is_plant_certificate(const CertificateFacts& facts);
// Returns the role of a plant's certificate; nothing if this release has no such role.
std::optional<Role> plant_role(const CertificateFacts& facts);

// Returns true for a word that names a role, so that no board or tool gets it as its name by mistake.
bool reserved_name(const std::string& name);
// Returns the command that makes keys for this role: "indurop keys add --viewer NAME".
std::string how_to_add(Role role, const std::string& name);

class PlantKeys {
 public:
  explicit PlantKeys(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Calls that return a problem have changed nothing.
  Result<void, base::Problem> make(const std::string& plant, const std::vector<std::string>& boards,
                                   Instant until) const;
  Result<void, base::Problem> add(const std::string& board, Instant until) const;
  // Adds a viewer or deployer. Boards accept deployments of a new deployer after they got the new deploy.pub.
  Result<void, base::Problem> add_viewer(const std::string& name, Instant until) const;
  Result<void, base::Problem> add_deployer(const std::string& name, Instant until) const;
  // Adds a person who commands boards as the plant's list of users allows.
  Result<void, base::Problem> add_user(const std::string& name, Instant until) const;
  // Adds a tool, a program that reads and sets variables of the external plane. Its lists are stored in its keys
  // folder, in variables.txt.
  Result<void, base::Problem> add_tool(const std::string& name, const VariableRights& rights, Instant until) const;
  // Makes a new certificate and new permissions for the old key; for a tool, those that variables.txt lists now.
  Result<void, base::Problem> renew(const KeyListing& whose, Instant until) const;
  // Revokes the certificate: participants that have the new list, which is copied to all folders, reject it. Boards
  // with the new deploy.pub also reject deployments of a revoked deployer.
  Result<void, base::Problem> revoke(const KeyListing& whose) const;
  // Makes a new signing key for a deployer. The old one stays valid until finish_rotation().
  Result<void, base::Problem> rotate(const KeyListing& deployer) const;
  // Makes old keys invalid. Returns their number.
  Result<std::size_t, base::Problem> finish_rotation() const;
  // Returns the signed list (core/keys/trust_list.h) of what is valid, for the boards; makes one if none matches the
  // other files.
  [[nodiscard]] Result<std::string, base::Problem> trust_list() const;

  [[nodiscard]] bool exist() const;
  // Returns why a file that all participants share cannot be read, and must not be written without what is in it;
  // empty if each can be read or does not exist.
  [[nodiscard]] std::string unreadable() const;
  [[nodiscard]] std::string plant() const;  // empty: there is no readable authority
  [[nodiscard]] std::vector<KeyListing> list(Instant now) const;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path board(const std::string& name) const { return folder_ / "boards" / name; }
  [[nodiscard]] std::filesystem::path tool(const std::string& name) const { return folder_ / "tools" / name; }
  [[nodiscard]] std::filesystem::path user(const std::string& name) const { return folder_ / "users" / name; }
  [[nodiscard]] std::filesystem::path viewer(const std::string& name = "viewer") const;
  [[nodiscard]] std::filesystem::path deployer(const std::string& name = "deployer") const;
  [[nodiscard]] std::filesystem::path authority_key() const;

 private:
  Result<void, base::Problem> add(const Holder& holder, Instant until) const;
  Result<void, base::Problem> share_deploy_keys(const std::string& list) const;
  // Restores revoked.pem from the signed list, if it is damaged or that of a backup: a certificate that was revoked
  // once stays revoked (RFC 5280, 5.3.1).
  [[nodiscard]] Result<void, base::Problem> restore_revoked() const;
  [[nodiscard]] Result<void, base::Problem> check_deploy_keys() const;
  // Returns true if deploy.pub has the public half of this private key.
  [[nodiscard]] bool is_valid(const std::filesystem::path& deploy_key) const;
  // Signs a list of what the files in the folder say.
  Result<void, base::Problem> share_trust() const;
  // Copies a file that all participants have to all folders.
  Result<void, base::Problem> share(const char* file, const std::string& text) const;
  std::filesystem::path folder_;
};

}  // namespace indurop::keys
