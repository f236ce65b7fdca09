// SPDX-License-Identifier: Apache-2.0
// What an agent keeps on disk: files by their digest, deployments made of them, and which one is committed. The last is
// one file that is only ever replaced whole, so whatever happens to the board in between, it has one committed
// deployment. What the disk has changed is noticed by its digest, dropped, and made again from what is sound. Layout:
// docs/deploy.md.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/problem.h"
#include "deploy/disk/committed_file.h"
#include "deploy/disk/deployment_files.h"
#include "deploy/transaction/package.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class AgentState {
 public:
  // Takes the board's folder for this process. `tell` gets a line for people about each file that is damaged. A
  // committed.json that is damaged is set aside: the board begins without a deployment and takes over that of the
  // others. A problem: no rights, or another agent has the folder.
  using Tell = std::function<void(const std::string& line)>;
  static Result<AgentState, base::Problem> open(const std::string& board, Tell tell = {});
  AgentState(AgentState&& other) noexcept;
  AgentState& operator=(AgentState&&) = delete;
  AgentState(const AgentState&) = delete;
  AgentState& operator=(const AgentState&) = delete;
  ~AgentState();

  [[nodiscard]] const Committed& committed() const noexcept { return committed_; }
  // Replaces it on disk, then here. With a problem nothing has changed.
  Result<void, base::Problem> commit(Committed next);
  // Text of history, for tools.
  [[nodiscard]] std::string history_text() const;

  [[nodiscard]] const DeploymentFiles& files() const noexcept { return files_; }
  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return files_.file(digest); }
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return files_.part(digest); }
  [[nodiscard]] bool has(const std::string& digest) const { return files_.has(digest); }
  // The file is here and is what its name says; one that is not is dropped. `name`: for people.
  bool has_sound(const std::string& digest, const std::string& name);
  // A part that is complete and sound becomes a file, and lasts.
  Result<void, base::Problem> keep(const std::string& digest);

  // The package of a deployment whose files are all here. A problem: it is not here, or damaged.
  [[nodiscard]] Result<Package, base::Problem> package(const std::string& id) const { return files_.package(id); }
  // Lays out the deployment's files under their names, or verifies those that are there and makes them again from
  // files/. After success every file has the digest that the package names. A problem names the file.
  Result<void, base::Problem> install(const std::string& id);
  // The same, and files/ has all of the deployment afterwards, too: what one of the two has lost comes from the other.
  Result<void, base::Problem> repair(const std::string& id);
  // files/ has this file of the deployment, and it is sound; made again from the deployment's folder if need be. A
  // problem: neither copy is sound.
  Result<void, base::Problem> restore(const std::string& id, const PackageFile& entry);
  // Where its manifest is when it is installed; its folder if that cannot be said, because its package is damaged.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Removes what neither the committed nor the previous deployment nor the newest of history needs. What has come of
  // `tried`, a deployment that was given up, stays for the next attempt.
  void collect_garbage(const std::string& tried = {});
  // The same at the agent's start, when a deployment may have been cut short: only what is older than a day goes.
  void collect_old_garbage();
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return files_.folder(); }

 private:
  AgentState(std::filesystem::path folder, int lock, Tell tell)
      : files_(std::move(folder)), lock_(lock), tell_(std::move(tell)) {}
  Result<void, base::Problem> load();
  void tell(const std::string& line) const;
  Result<void, base::Problem> lay_out(const Package& package, const std::filesystem::path& fresh);
  Result<void, base::Problem> keep_copy(const std::filesystem::path& copy, const std::string& digest);
  struct Needed {
    std::set<std::string> files;
    std::set<std::string> folders;  // in deployments/
  };
  [[nodiscard]] Needed needed_by(const std::set<std::string>& ids) const;
  void remove_files_but(const std::set<std::string>& needed, bool old_only) const;

  DeploymentFiles files_;
  int lock_ = -1;
  Tell tell_;
  Committed committed_;
};

}  // namespace indurop::deploy
