// SPDX-License-Identifier: Apache-2.0
// Recordings of this board's node for somebody elsewhere: one at a time, by `indurop record` as a process of its own,
// to a file of bounded size on this board's disk. It ends when nobody asks for it any more, with the node and with the
// agent. Its file stays until it was fetched or the next recording begins.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/log.h"
#include "deploy/words/command_words.h"
#include "rt/clock.h"

namespace indurop::deploy {

class BoardRecorder {
 public:
  struct Limits {
    std::chrono::seconds lease{15};              // since it was asked for last
    std::uint64_t most_bytes = 1U << 30U;        // of a recording
    std::uint64_t least_free_bytes = 1U << 28U;  // of the disk
  };
  // `program`: indurop.
  BoardRecorder(std::string board, std::filesystem::path program, Limits limits, const base::Log& log);
  BoardRecorder(const BoardRecorder&) = delete;
  BoardRecorder& operator=(const BoardRecorder&) = delete;
  ~BoardRecorder();

  struct Answer {
    Outcome outcome = Outcome::Refused;
    std::string text;
  };
  // Not real-time safe. Carries out Action::Record, EndRecord and DropRecord; `host`: of whoever wants it.
  Answer begin(const Command& command, rt::MonoTime now);
  // What has become of a command that is under way; nothing while it is.
  [[nodiscard]] std::optional<Answer> look(Action action) const;
  void step(rt::MonoTime now);

 private:
  Answer record(const Command& command, rt::MonoTime now);
  Answer start(const std::vector<std::string>& names, bool past);
  void end(const std::string& why, rt::MonoTime now);
  void note_end(int status);
  // Why it cannot go on; empty: it can.
  [[nodiscard]] std::string limit() const;
  [[nodiscard]] std::string errors() const;

  std::string board_;
  std::filesystem::path program_;
  Limits limits_;
  const base::Log& log_;
  std::string name_;     // of the latest one; empty: there was none since this agent began
  std::string host_;     // that wants it
  std::string unknown_;  // names that no variable has, in a line each
  std::string ended_;    // why, if not as wished
  std::string lacks_;    // what is missing in it, in a line each
  pid_t pid_ = -1;
  bool begun_ = false;  // its file is there
  bool asked_ = false;  // to end
  rt::MonoTime kill_at_;
  rt::MonoTime lease_until_;
  rt::MonoTime look_at_;  // at its size
};

// {"recordings": [{"name", "bytes"}]}
std::string recordings_text(const std::string& board);
// The file of that name in the list, and no other.
std::optional<std::filesystem::path> recording_file(const std::string& board, const std::string& name);

}  // namespace indurop::deploy
