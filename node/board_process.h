// SPDX-License-Identifier: Apache-2.0
// The node of a board as a child of its agent: starts it, ends it, brings it back when it dies, and sees how it does.
// A node that outlived its agent is taken over instead of started again.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/deployment_words.h"
#include "node/console.h"
#include "vars/run_file.h"

namespace indurop::node {

class BoardProcess {
 public:
  static constexpr std::int64_t kRestartNs = 1'000'000'000;
  static constexpr std::int64_t kRestartWindowNs = 60'000'000'000;
  static constexpr std::size_t kRestarts = 3;  // within the window

  // `arguments`: of every node started, besides the manifest and the board.
  BoardProcess(std::string board, std::vector<std::string> arguments, Console& console);
  BoardProcess(const BoardProcess&) = delete;
  BoardProcess& operator=(const BoardProcess&) = delete;
  ~BoardProcess();

  // What should run from now on, and its id; empty: nothing. The same again: a node that has failed gets a new chance.
  void want(const std::filesystem::path& manifest, const std::string& deployment);
  // The node is ended and stays down until release() or want(); `reason` is what people are told.
  void hold(const std::string& reason);
  void release();
  [[nodiscard]] const std::string& held() const noexcept { return held_; }  // the reason, empty: not held
  [[nodiscard]] bool has_node() const noexcept { return pid_ > 0; }
  void step(std::int64_t now_ns);
  // Ends the node and waits for that.
  void end();
  // Lets go of the node; it runs on.
  void leave() noexcept;

  [[nodiscard]] deploy::NodeCondition condition() const noexcept { return condition_; }
  // Why it failed, or what it said last before it died.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

  struct Figures {
    std::uint64_t tick = 0;
    std::uint64_t lost_ticks = 0;
    std::uint64_t overruns = 0;
    std::uint64_t faults = 0;
  };
  [[nodiscard]] Figures figures();
  // For a trial: what went wrong since want(), and else what is still missing for the node to be well.
  struct Health {
    std::string problem;
    std::string missing;
  };
  // `boards`: those that are to be there.
  [[nodiscard]] Health health(const std::vector<std::string>& boards);

 private:
  void launch(std::int64_t now_ns);
  bool adopt();
  void read_output();
  bool ended(int& status);
  void note_end(int status, std::int64_t now_ns);
  void signal_stop(std::int64_t now_ns);
  bool look();  // run_ is that of the present node

  std::string board_;
  std::vector<std::string> arguments_;
  Console& console_;
  std::filesystem::path wanted_;
  std::string deployment_;  // its id
  std::filesystem::path running_;
  std::string held_;
  pid_t pid_ = -1;
  bool adopted_ = false;
  int output_ = -1;
  std::string line_;
  std::string last_error_;
  bool asked_to_stop_ = false;
  std::int64_t kill_ns_ = 0;
  std::int64_t start_ns_ = 0;  // not before
  std::deque<std::int64_t> restarts_;
  std::uint32_t deaths_ = 0;  // since want()
  deploy::NodeCondition condition_ = deploy::NodeCondition::None;
  std::string reason_;
  std::optional<vars::RunFile> run_;
};

}  // namespace indurop::node
