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
};

class PlantKeys {
 public:
  explicit PlantKeys(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // A call with a problem has changed nothing.
  Result<void, base::Problem> make(const std::string& plant, const std::vector<std::string>& boards,
                                   Instant until) const;
  Result<void, base::Problem> add(const std::string& board, Instant until) const;
  // A program that reads and sets variables of the external plane. The lists are kept beside its keys, in
  // variables.txt.
  Result<void, base::Problem> add_tool(const std::string& name, const VariableRights& rights, Instant until) const;
  // A new certificate and new permissions for the old key; for a tool those that variables.txt names now.
  Result<void, base::Problem> renew(const KeyListing& whose, Instant until) const;
  // The certificate counts no more for participants that have the new list, which is put into all folders.
  Result<void, base::Problem> revoke(const KeyListing& whose) const;

  [[nodiscard]] bool exist() const;
  [[nodiscard]] std::string plant() const;  // empty: there is no authority that can be read
  [[nodiscard]] std::vector<KeyListing> list(Instant now) const;

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path board(const std::string& name) const { return folder_ / "boards" / name; }
  [[nodiscard]] std::filesystem::path tool(const std::string& name) const { return folder_ / "tools" / name; }
  [[nodiscard]] std::filesystem::path viewer() const { return folder_ / "viewer"; }
  [[nodiscard]] std::filesystem::path deployer() const { return folder_ / "deployer"; }

 private:
  Result<void, base::Problem> add(const Holder& holder, Instant until) const;
  std::filesystem::path folder_;
};

}  // namespace indurop::keys
