// SPDX-License-Identifier: Apache-2.0
// Recordings of boards in the network: started on their agents, kept running by repeated requests, ended, and fetched
// from the boards' disks.

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
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"

namespace indurop::tools {

class BoardRecordings {
 public:
  // `self`: session of the link, which is also the name of the recordings.
  BoardRecordings(std::unique_ptr<deploy::DeployLink> link, std::uint64_t self, BoardCommander commander);
  BoardRecordings(const BoardRecordings&) = delete;
  BoardRecordings& operator=(const BoardRecordings&) = delete;
  ~BoardRecordings() = default;

  // Receives until these boards are discovered, at most for three seconds.
  void discover(const std::vector<std::string>& boards);
  // `names`: variables or globs to record; none: all. Returns those without a match on the board; if these are all, the
  // board is not recorded. Fails if the board was not discovered, runs another plant or refuses.
  Result<std::vector<std::string>, Failure> begin(const std::string& board, const std::string& plant,
                                                  const std::vector<std::string>& names, bool past);
  // Repeats the requests for all of them in a thread until end().
  void go_on();
  // Ends them. Returns what is wrong with them or missing in them.
  std::vector<std::string> end();
  // Fetches each to a file in the folder, named after its board. Returns the files, and what went wrong.
  std::pair<std::vector<std::filesystem::path>, std::vector<std::string>> fetch(const std::filesystem::path& folder);
  // Allows the boards to delete them.
  void drop();
  [[nodiscard]] bool empty() const noexcept { return all_.empty(); }

 private:
  struct One {
    deploy::BoardReport board;
    std::string target;  // of the command that started it
  };
  Result<Answered, Failure> send(const One& one, deploy::Action action, std::chrono::nanoseconds timeout);
  void repeat(const std::stop_token& stop);
  std::string end(const One& one);
  void refresh();
  // Returns the current agent of the board, which may not be the one that started the recording.
  std::uint64_t agent_of(const std::string& board);

  std::unique_ptr<deploy::DeployLink> link_;
  std::uint64_t self_;
  std::string name_;
  BoardCommander commander_;
  BoardRoster roster_;
  std::vector<One> all_;
  std::jthread thread_;  // while it runs, only it uses link and commander
};

}  // namespace indurop::tools
