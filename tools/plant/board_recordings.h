// SPDX-License-Identifier: Apache-2.0
// Recordings of boards in the network: begun by their agents, kept going as long as somebody wants them, ended, and
// fetched from the boards' disks.

#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/plant/board_commander.h"
#include "tools/plant/board_roster.h"

namespace indurop::tools {

class BoardRecordings {
 public:
  // `self`: session of the link, which is the recordings' name, too.
  BoardRecordings(std::unique_ptr<deploy::DeployLink> link, std::uint64_t self, BoardCommander commander);
  BoardRecordings(const BoardRecordings&) = delete;
  BoardRecordings& operator=(const BoardRecordings&) = delete;
  ~BoardRecordings() = default;

  // Listens until these boards are heard, or for three seconds.
  void hear(const std::vector<std::string>& boards);
  // `names`: wanted variables or globs; none: all. Returns those that no variable of the board matches; are these all,
  // the board is not recorded. Fails if the board was not heard, runs another plant or refuses.
  Result<std::vector<std::string>, Failure> begin(const std::string& board, const std::string& plant,
                                                  const std::vector<std::string>& names, bool past);
  // Asks for all of them again and again until end().
  void go_on();
  // Ends them. Returns what is wrong with them, or is missing in them.
  std::vector<std::string> end();
  // To a file of the folder each, named as its board; not without what went wrong.
  std::pair<std::vector<std::filesystem::path>, std::vector<std::string>> fetch(const std::filesystem::path& folder);
  // The boards may forget them.
  void drop();
  [[nodiscard]] bool empty() const noexcept { return all_.empty(); }

 private:
  struct One {
    deploy::BoardReport board;
    std::string target;  // of the command that began it
  };
  Result<Answered, Failure> give(const One& one, deploy::Action action, std::chrono::nanoseconds timeout);
  void repeat(const std::stop_token& stop);
  std::string end(const One& one);
  void refresh();
  // Its agent now, which may not be the one that began it.
  std::uint64_t agent_of(const std::string& board);

  std::unique_ptr<deploy::DeployLink> link_;
  std::uint64_t self_;
  std::string name_;
  BoardCommander commander_;
  BoardRoster roster_;
  std::vector<One> all_;
  std::jthread thread_;  // while it runs, link and commander are its own
};

}  // namespace indurop::tools
