// SPDX-License-Identifier: Apache-2.0
// The files of deployments in the state folder of a board: files/ has each by its SHA-256, deployments/ a copy of them
// under their own names, which is what runs. Both are compared with their digests here; nothing is believed because it
// was right before.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.h"
#include "deploy/transaction/package.h"

namespace indurop::deploy {

// A file that is not what it has to be.
struct Damage {
  std::filesystem::path file;
  std::string name;      // in the deployment, or what it is; of committed.json what is wrong with it
  std::string expected;  // SHA-256; empty: committed.json, which has it in itself
  std::string found;     // likewise; empty: there is no such file, or it cannot be read
};
// "main.so: FILE has the SHA-256 ..., it should be ..."
std::string describe(const Damage& damage);

class DeploymentFiles {
 public:
  explicit DeploymentFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return folder_ / "files" / digest; }
  // A file that is being fetched.
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return folder_ / "parts" / digest; }
  // Of a deployment under the names of its files.
  [[nodiscard]] std::filesystem::path deployment(const std::string& id) const;
  // There is such a file; what is in it was not looked at.
  [[nodiscard]] bool has(const std::string& digest) const;

  // The list of a deployment's files. A problem: it is not here, or damaged.
  [[nodiscard]] Result<Package, base::Problem> package(const std::string& id) const;

  // What is wrong with one of files/. Reads all of it, as the next one.
  [[nodiscard]] std::optional<Damage> damage_of(const std::string& digest, const std::string& name) const;
  // What is wrong with one file of a deployment's folder.
  [[nodiscard]] std::optional<Damage> damage_in(const std::string& id, const PackageFile& entry) const;
  // The first damage of a deployment's folder.
  [[nodiscard]] std::optional<Damage> damage_in(const std::string& id, const Package& package) const;

 private:
  std::filesystem::path folder_;
};

// A copy that shares its blocks with the original where the file system can do that. Replaces `to`.
Result<void, base::Problem> clone_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace indurop::deploy
