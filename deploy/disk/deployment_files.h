// SPDX-License-Identifier: Apache-2.0
// The files of deployments in the state folder of a board: files/ has each by its SHA-256, deployments/ has a copy of
// them under their own names, which is what runs. Both are compared with their digests every time; an earlier
// comparison is not relied on.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "deploy/transaction/package.h"

namespace indurop::deploy {

// A file that does not have its expected digest.
struct Damage {
  std::filesystem::path file;
  std::string name;      // name in the deployment, or what the file is; for committed.json what is wrong with it
  std::string expected;  // SHA-256; empty: committed.json, which contains its own
  std::string found;     // SHA-256; empty: there is no such file, or it cannot be read
};
// Returns "main.so: FILE has the SHA-256 ..., it should be ..."
std::string describe(const Damage& damage);

class DeploymentFiles {
 public:
  explicit DeploymentFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return folder_ / "files" / digest; }
  // Returns the path of a file that is being fetched.
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return folder_ / "parts" / digest; }
  // Returns the folder of a deployment, with its files under their own names.
  [[nodiscard]] std::filesystem::path deployment(const std::string& id) const;
  // Returns whether there is such a file; its content is not checked.
  [[nodiscard]] bool has(const std::string& digest) const;

  // Returns the list of a deployment's files. A problem: it is not stored, or damaged.
  [[nodiscard]] Result<Package, base::Problem> package(const std::string& id) const;

  // Returns what is wrong with one file of files/. Reads all of it, like the next function.
  [[nodiscard]] std::optional<Damage> damage_of(const std::string& digest, const std::string& name) const;
  // Returns what is wrong with one file of a deployment's folder.
  [[nodiscard]] std::optional<Damage> damage_in(const std::string& id, const PackageFile& entry) const;
  // Returns the first damage of a deployment's folder.
  [[nodiscard]] std::optional<Damage> damage_in(const std::string& id, const Package& package) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace indurop::deploy
