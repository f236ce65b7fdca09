// SPDX-License-Identifier: Apache-2.0
// What an agent keeps on disk: files by their digest, deployments made of them, and which one is committed. The last is
// one file that is only ever replaced whole, so whatever happens to the board in between, it has one committed
// deployment. Layout: docs/deploy.md.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/problem.h"
#include "deploy/transaction/package.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

struct HistoryEntry {
  std::string deployment;
  std::string plant;
  std::uint64_t generation = 0;
  std::string host;  // that deployed it
  std::int64_t wall_ns = 0;
  std::string outcome;  // "committed", or why it was rolled back
};

struct Committed : CommittedDeployment {
  std::vector<HistoryEntry> history;  // newest last
};

class AgentState {
 public:
  // Takes the board's folder for this process. A problem: no rights, another agent has it, it is damaged.
  static Result<AgentState, base::Problem> open(const std::string& board);
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

  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return folder_ / "files" / digest; }
  // A file that is being fetched.
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return folder_ / "parts" / digest; }
  [[nodiscard]] bool has(const std::string& digest) const;
  // A part that is complete and sound becomes a file, and lasts.
  Result<void, base::Problem> keep(const std::string& digest);

  // The package of a deployment whose files are all here. A problem: it is not here, or damaged.
  [[nodiscard]] Result<Package, base::Problem> package(const std::string& id) const;
  // Lays out the deployment's files under their names.
  Result<void, base::Problem> install(const std::string& id);
  // Its manifest, installed; empty path if it is not here.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Removes what neither the committed nor the previous deployment nor the newest of history needs. What has come of
  // `tried`, a deployment that was given up, stays for the next attempt.
  void collect_garbage(const std::string& tried = {});
  // The same at the agent's start, when a deployment may have been cut short: only what is older than a day goes.
  void collect_old_garbage();
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  AgentState(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  Result<void, base::Problem> load();
  [[nodiscard]] std::filesystem::path deployment(const std::string& id) const;
  struct Needed {
    std::set<std::string> files;
    std::set<std::string> folders;  // in deployments/
  };
  [[nodiscard]] Needed needed_by(const std::set<std::string>& ids) const;
  [[nodiscard]] std::set<std::string> kept() const;  // deployments

  std::filesystem::path folder_;
  int lock_ = -1;
  Committed committed_;
};

}  // namespace indurop::deploy
