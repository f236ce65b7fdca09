// SPDX-License-Identifier: Apache-2.0
// What an agent keeps on disk: files by their digest, deployments made of them, and which one is committed. The last is
// one file that is only ever replaced whole, so whatever happens to the board in between, it has one committed
// deployment. Layout: docs/deploy.md.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/package.h"

namespace indurop::node {

struct HistoryEntry {
  std::string deployment;
  std::string plant;
  std::uint64_t generation = 0;
  std::string host;  // that deployed it
  std::int64_t wall_ns = 0;
  std::string outcome;  // "committed", or why it was rolled back
};

struct Committed {
  std::uint64_t generation = 0;
  std::string plant;
  std::string current;  // deployment ids, empty: none
  std::uint64_t current_size = 0;
  std::string grant;  // signature of the deployer, empty: unsigned
  std::string previous;
  std::vector<std::string> members;
  std::vector<HistoryEntry> history;  // newest last
};

class AgentState {
 public:
  // Takes the board's folder for this process. Empty, and `problem` says why: no rights, another agent has it.
  static std::optional<AgentState> open(const std::string& board, std::string& problem);
  AgentState(AgentState&& other) noexcept;
  AgentState& operator=(AgentState&&) = delete;
  AgentState(const AgentState&) = delete;
  AgentState& operator=(const AgentState&) = delete;
  ~AgentState();

  [[nodiscard]] const Committed& committed() const noexcept { return committed_; }
  // Replaces it on disk, then here. Empty, or what went wrong; then nothing has changed.
  std::string commit(Committed next);
  // Text of history, for tools.
  [[nodiscard]] std::string history_text() const;

  [[nodiscard]] std::filesystem::path file(const std::string& digest) const { return folder_ / "files" / digest; }
  // A file that is being fetched.
  [[nodiscard]] std::filesystem::path part(const std::string& digest) const { return folder_ / "parts" / digest; }
  [[nodiscard]] bool has(const std::string& digest) const;
  // A part that is complete and sound becomes a file, and lasts. Empty, or what went wrong.
  std::string keep(const std::string& digest);

  // The package of a deployment whose files are all here. Empty: it is not here, or damaged.
  [[nodiscard]] std::optional<deploy::Package> package(const std::string& id, std::string& problem) const;
  // Lays out the deployment's files under their names. Empty, or what went wrong.
  std::string install(const std::string& id);
  // Its manifest, installed; empty path if it is not here.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Removes what neither the committed nor the previous deployment nor the newest of history needs.
  void collect_garbage();
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  AgentState(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::string load();
  [[nodiscard]] std::filesystem::path deployment(const std::string& id) const;

  std::filesystem::path folder_;
  int lock_ = -1;
  Committed committed_;
};

}  // namespace indurop::node
