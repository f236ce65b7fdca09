// SPDX-License-Identifier: Apache-2.0
// A plant's keys as a folder (docs/security.md): the authority in it, and one folder for each board and for the other
// participants, which is all that they need. Private keys are readable by their owner only and never replaced.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.h"
#include "keys/credentials.h"
#include "keys/dds_documents.h"
#include "keys/participant_keys.h"

namespace indurop::keys {

struct KeyListing {
  Role role = Role::Board;
  std::string name;
  std::filesystem::path folder;
  Validity validity;
  bool revoked = false;
  std::string problem;       // empty: it can be used
  VariableRights variables;  // of a tool
  std::string exposed;       // exposed_key() of its private keys
};

// Is it the certificate of a plant's authority, or one that such an authority has issued?
bool is_plant_authority(const CertificateFacts& facts);
bool is_plant_certificate(const CertificateFacts& facts);
// What a certificate of a plant is for; nothing: none that this release makes.
std::optional<Role> plant_role(const CertificateFacts& facts);

// A word that means a role, so that no board or tool is made of it by mistake.
bool reserved_name(const std::string& name);
// "indurop keys add --viewer NAME": what makes keys for this role.
std::string how_to_add(Role role, const std::string& name);

class PlantKeys {
 public:
  explicit PlantKeys(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // A call with a problem has changed nothing.
  Result<void, base::Problem> make(const std::string& plant, const std::vector<std::string>& boards,
                                   Instant until) const;
  Result<void, base::Problem> add(const std::string& board, Instant until) const;
  // A further viewer or deployer. Deployments signed by a new deployer count where the new deploy.pub is.
  Result<void, base::Problem> add_viewer(const std::string& name, Instant until) const;
  Result<void, base::Problem> add_deployer(const std::string& name, Instant until) const;
  // A program that reads and sets variables of the external plane. The lists are kept beside its keys, in
  // variables.txt.
  Result<void, base::Problem> add_tool(const std::string& name, const VariableRights& rights, Instant until) const;
  // A new certificate and new permissions for the old key; for a tool those that variables.txt names now.
  Result<void, base::Problem> renew(const KeyListing& whose, Instant until) const;
  // The certificate counts no more for participants that have the new list, which is put into all folders. Nor do
  // deployments of a deployer, where the new deploy.pub is.
  Result<void, base::Problem> revoke(const KeyListing& whose) const;
  // A new key that signs a deployer's deployments. The former one counts too, until finish_rotation().
  Result<void, base::Problem> rotate(const KeyListing& deployer) const;
  // Former keys count no more. How many there were.
  Result<std::size_t, base::Problem> finish_rotation() const;

  [[nodiscard]] bool exist() const;
  [[nodiscard]] std::string plant() const;  // empty: there is no authority that can be read
  [[nodiscard]] std::vector<KeyListing> list(Instant now) const;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path board(const std::string& name) const { return folder_ / "boards" / name; }
  [[nodiscard]] std::filesystem::path tool(const std::string& name) const { return folder_ / "tools" / name; }
  [[nodiscard]] std::filesystem::path viewer(const std::string& name = "viewer") const;
  [[nodiscard]] std::filesystem::path deployer(const std::string& name = "deployer") const;
  [[nodiscard]] std::filesystem::path authority_key() const;

 private:
  Result<void, base::Problem> add(const Holder& holder, Instant until) const;
  // Puts a file that all have into all folders.
  Result<void, base::Problem> share(const char* file, const std::string& text) const;
  std::filesystem::path folder_;
};

}  // namespace indurop::keys
