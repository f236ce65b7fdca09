// SPDX-License-Identifier: Apache-2.0
// Compares everything in the state folder of a board that has a digest with it: committed.json, files/, and the folders
// of the deployments that are kept; and the same of the releases of the platform, in platform/. Only reads; in small
// pieces, so that an agent can do other work meanwhile.

#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/json.h"
#include "core/keys/digest.h"
#include "deploy/disk/deployment_files.h"

namespace indurop::deploy {

struct StateReport {
  std::uint64_t files = 0;  // files read
  std::uint64_t bytes = 0;
  std::vector<std::string> deployments;  // ids of the deployments that the board keeps
  std::vector<std::string> releases;     // ids of the releases of the platform that it keeps
  std::vector<Damage> damaged;
};
// {"files", "bytes", "deployments", "releases", "damaged": [{"file", "name", "sha256", "found"}]}
base::Json json_of(const StateReport& report);

class StateCheck {
 public:
  explicit StateCheck(const std::filesystem::path& folder);

  // Checks some more megabytes. Returns true when all is done.
  bool step();
  [[nodiscard]] const StateReport& report() const noexcept { return report_; }

 private:
  struct Kept;
  void plan(const Kept& kept);
  void plan_folder(const DeploymentFiles& files, const std::string& id);
  void begin_next();
  void note(std::string found);

  std::deque<Damage> wanted_;  // still to be checked; `found` is empty
  base::Descriptor open_;
  std::optional<keys::Digest> digest_;
  StateReport report_;
};

}  // namespace indurop::deploy
