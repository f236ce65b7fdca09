// SPDX-License-Identifier: Apache-2.0
// Recordings of this board's node for a remote client: one at a time, by `indurop record` as a separate process, to a
// file of limited size on this board's disk. A recording ends when no client requests it any more, with the node and
// with the agent. Its file stays until it was fetched or the next recording begins.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

class BoardRecorder {
 public:
  struct Limits {
    std::chrono::seconds lease{15};              // since the last request
    std::uint64_t most_bytes = 1U << 30U;        // maximum size of a recording
    std::uint64_t least_free_bytes = 1U << 28U;  // minimum free space on the disk
  };
  // `program`: path of indurop.
  BoardRecorder(std::string board, std::filesystem::path program, Limits limits, const base::Log& log);
  BoardRecorder(const BoardRecorder&) = delete;
  BoardRecorder& operator=(const BoardRecorder&) = delete;
  ~BoardRecorder();

  struct Answer {
    Outcome outcome = Outcome::Refused;
    std::string text;
  };
  // Not real-time safe. Executes Action::Record, EndRecord and DropRecord; the `host` in the command is the requesting
  // client's.
  Answer begin(const Command& command, rt::MonoTime now);
  // Returns the outcome of a command; nothing while it is under way.
  [[nodiscard]] std::optional<Answer> poll(Action action) const;
  void step(rt::MonoTime now);

 private:
  Answer record(const Command& command, rt::MonoTime now);
  Answer start(const std::vector<std::string>& names, bool past);
  void end(const std::string& why, rt::MonoTime now);
  void note_end(int status);
  // Returns why it cannot continue; empty: it can.
  [[nodiscard]] std::string limit() const;
  [[nodiscard]] std::string errors() const;

  std::string board_;
  std::filesystem::path program_;
  Limits limits_;
  const base::Log& log_;
  std::string name_;     // name of the latest recording; empty: none since this agent began
  std::string host_;     // host of the client that requests it
  std::string unknown_;  // patterns that match no variable, one per line
  std::string ended_;    // why it ended, if not as requested
  std::string lacks_;    // what is missing in it, one item per line
  pid_t pid_ = -1;
  bool begun_ = false;  // its file exists
  bool asked_ = false;  // it was asked to end
  rt::MonoTime kill_at_;
  rt::MonoTime lease_until_;
  rt::MonoTime next_check_;  // next check of its size
};

// {"recordings": [{"name", "bytes"}]}
std::string recordings_text(const std::string& board);
// Returns the file with that name in the list, and no other.
std::optional<std::filesystem::path> recording_file(const std::string& board, const std::string& name);

}  // namespace indurop::deploy
