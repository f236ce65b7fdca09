// SPDX-License-Identifier: Apache-2.0
// The state of an agent on disk: files by their digest, the deployments made of them, and which deployment is
// committed. The latter is one file that is only ever replaced as a whole, so the board has exactly one committed
// deployment whatever happens to it meanwhile. Files that the disk has corrupted are detected by their digest,
// discarded, and restored from an intact copy. Layout: docs/deploy.md.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "deploy/disk/committed_file.h"
#include "deploy/disk/deployment_files.h"
#include "deploy/disk/disk_reserve.h"
#include "deploy/transaction/package.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class AgentState {
 public:
  // Locks the board's folder for this process. `log` gets a line for people about each damaged file. A damaged
  // committed.json is set aside: the board begins without a deployment and takes over that of the other boards. A
  // problem: no access, or another agent holds the folder.
  using Log = std::function<void(const std::string& line)>;
  static Result<AgentState, base::Problem> open(const std::string& board, Log log = {});
  // As open(), for the releases of the platform, which are kept as deployments are: the running and the former one.
  static Result<AgentState, base::Problem> open_platform(const std::string& board, Log log = {});
  AgentState(AgentState&& other) noexcept;
  AgentState& operator=(AgentState&&) = delete;
  AgentState(const AgentState&) = delete;
  AgentState& operator=(const AgentState&) = delete;
  ~AgentState();

  [[nodiscard]] const Committed& committed() const noexcept { return committed_; }
  // Replaces the committed deployment on disk, then in memory. With a problem nothing has changed. If the disk is full,
  // the reserve is used.
  Result<void, base::Problem> commit(Committed next);
  // Returns the history as text for tools.
  [[nodiscard]] std::string history_text() const;

  // collect_garbage() takes it again, if it can.
  [[nodiscard]] const DiskReserve& reserve() const noexcept { return reserve_; }

  [[nodiscard]] const DeploymentFiles& files() const noexcept { return files_; }
  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return files_.file(digest); }
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return files_.part(digest); }
  [[nodiscard]] bool has(const std::string& digest) const { return files_.has(digest); }
  // Returns true if the file exists and matches its digest; one that does not is discarded. `name`: for people.
  bool has_sound(const std::string& digest, const std::string& name);
  // Turns a complete and intact part into a file, durably.
  Result<void, base::Problem> keep(const std::string& digest);

  // Returns the package of a deployment whose files are all stored. A problem: it is not stored, or damaged.
  [[nodiscard]] Result<Package, base::Problem> package(const std::string& id) const { return files_.package(id); }
  // Lays out the deployment's files under their names, or verifies the present ones and restores them from files/.
  // After success every file has the digest that the package names. A problem names the file.
  Result<void, base::Problem> install(const std::string& id);
  // As install(), and restores files/ too: a file that one of the two has lost is copied from the other.
  Result<void, base::Problem> repair(const std::string& id);
  // Makes sure that files/ has an intact copy of this file of the deployment, restored from the deployment's folder if
  // needed. A problem: neither copy is intact.
  Result<void, base::Problem> restore(const std::string& id, const PackageFile& entry);
  // Returns the path of its manifest when it is installed; its folder if its package is damaged.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Keeps one more folder: the one from which a node was started that has changed to later deployments since.
  void keep_folder_of(const std::filesystem::path& manifest);
  // Removes everything that the committed deployment, the previous one and the newest of the history do not need. The
  // files of `tried`, a deployment that was abandoned, are kept for the next attempt.
  void collect_garbage(const std::string& tried = {});
  // As collect_garbage(), at the agent's start, when a deployment may have been interrupted: removes only what is older
  // than a day.
  void collect_old_garbage();
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return files_.folder(); }

 private:
  AgentState(std::filesystem::path folder, int lock, std::size_t kept, Log log)
      : reserve_(folder), files_(std::move(folder)), lock_(lock), kept_(kept), log_(std::move(log)) {}
  static Result<AgentState, base::Problem> open_in(const std::filesystem::path& folder, const std::string& board,
                                                   std::size_t kept, Log log);
  Result<void, base::Problem> load();
  void log(const std::string& line) const;
  Result<void, base::Problem> lay_out(const Package& package, const std::filesystem::path& fresh);
  Result<void, base::Problem> keep_copy(const std::filesystem::path& copy, const std::string& digest);
  struct Needed {
    std::set<std::string> files;
    std::set<std::string> folders;  // in deployments/
  };
  [[nodiscard]] Needed needed_by(const std::set<std::string>& ids) const;
  void remove_files_but(const std::set<std::string>& needed, bool old_only) const;

  DiskReserve reserve_;
  DeploymentFiles files_;
  int lock_ = -1;
  std::size_t kept_;  // number of deployments
  Log log_;
  Committed committed_;
  std::string used_;  // name of that folder; empty: none
};

}  // namespace indurop::deploy
