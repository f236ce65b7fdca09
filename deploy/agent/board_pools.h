// SPDX-License-Identifier: Apache-2.0
// indurop-pools of this board as a child of its agent, as the manifest requires it: started when the board's node runs,
// started again when it dies, ended with the node or when the manifest has no pool for this board any more. It never
// affects the node. It ends with the agent; the next agent starts it again.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/pool_arguments.h"
#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/node_output.h"

namespace indurop::deploy {

// Path of indurop-pools, which belongs to this agent.
std::filesystem::path pools_program();

class BoardPools {
 public:
  struct Limits {
    std::chrono::milliseconds first{1000};      // pause after the first death; doubles with each one that follows soon
    std::chrono::milliseconds longest{30'000};  // longest pause
    std::chrono::milliseconds well{60'000};     // a program that has lived this long begins with the first pause again
    std::chrono::milliseconds grace{5'000};     // time to end before it is killed
  };
  // `further`: arguments in addition to those of the manifest. `one_host`: all boards run on this host.
  BoardPools(std::string board, std::filesystem::path program, std::vector<std::string> further, bool one_host,
             Limits limits, const base::Log& log);
  BoardPools(const BoardPools&) = delete;
  BoardPools& operator=(const BoardPools&) = delete;
  ~BoardPools();

  // To be called repeatedly. `manifest`: what the node is to run; empty: nothing. `node_runs`: it runs that. A program
  // whose arguments are the same for another manifest goes on, also while the node is started again.
  void step(const std::filesystem::path& manifest, bool node_runs, rt::MonoTime now);
  // Ends the program and waits until it has ended.
  void end();

  // Returns why the program does not run although it should, as text for people; empty: nothing is wrong.
  [[nodiscard]] std::string problem() const;
  // Returns {"state", "pid", "start_time", "deaths", "problem", "pools": [{"pool", "text"}]} as JSON, for tools; empty:
  // the manifest has no pool for this board.
  [[nodiscard]] std::string text() const;

 private:
  void read(const std::filesystem::path& manifest);
  void launch(rt::MonoTime now);
  void stop(rt::MonoTime now);
  void note_end(int status, rt::MonoTime now);
  // `why` ends with what the agent does about it.
  void fail(std::string why, rt::MonoTime now);
  void save();

  std::string board_;
  std::filesystem::path program_;
  std::vector<std::string> further_;
  bool one_host_;
  Limits limits_;
  const base::Log& log_;
  NodeOutput output_;
  std::filesystem::path manifest_;
  std::vector<std::string> wanted_;  // arguments; empty: it is not to run
  std::vector<config::BoardPool> pools_;
  std::vector<std::string> running_;  // arguments of the present program
  pid_t pid_ = -1;
  std::uint64_t start_time_ = 0;  // of pid_
  bool asked_to_stop_ = false;
  rt::MonoTime kill_at_{};
  rt::MonoTime started_at_{};
  rt::MonoTime start_at_{};  // earliest time of the next start
  std::chrono::milliseconds pause_{0};
  unsigned deaths_ = 0;  // since these arguments are wanted
  std::string problem_;
  bool changed_ = true;  // since text() was saved
};

}  // namespace indurop::deploy
