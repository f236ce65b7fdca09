// SPDX-License-Identifier: Apache-2.0
// The input record of a process module's run, as a replay gives it to the process again: readings of the clock, and
// answers of functions, channels and other boards. In shared memory that the node writes before each release.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "store/vars/shm_file.h"

namespace indurop::tape {

inline constexpr std::uint32_t kReplayInputAbi = 1;

// The bytes are valid until the next run is released.
struct ReplayedAnswer {
  std::int64_t code = 0;
  std::span<const std::uint8_t> bytes;
};

// The node's end. The memory is removed at the end.
class ReplayInputWriter {
 public:
  // `pid`: pid of the node. Errors: those of ShmFile::create() and publish().
  static Result<ReplayInputWriter> create(const std::string& node, std::int32_t pid);
  ReplayInputWriter(ReplayInputWriter&& other) noexcept
      : name_(std::exchange(other.name_, {})), file_(std::move(other.file_)) {}
  ReplayInputWriter& operator=(ReplayInputWriter&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(file_, other.file_);
    return *this;
  }
  ReplayInputWriter(const ReplayInputWriter&) = delete;
  ReplayInputWriter& operator=(const ReplayInputWriter&) = delete;
  ~ReplayInputWriter();

  // Writes the inputs of the run that is released next, while no run is active. If something does not fit, the run gets
  // it live.
  void give(std::span<const std::int64_t> readings, std::span<const ReplayedAnswer> answers) noexcept;

 private:
  ReplayInputWriter(std::string name, vars::ShmFile file) : name_(std::move(name)), file_(std::move(file)) {}
  std::string name_;
  vars::ShmFile file_;
};

// The process's end.
class ReplayInputReader {
 public:
  // Errors: NotFound (the node of this pid is no replay), VersionMismatch, Corrupt, those of ShmFile::open().
  static Result<ReplayInputReader> open(const std::string& node, std::int32_t pid);

  // The inputs of the run that was released last. Real-time safe.
  [[nodiscard]] std::span<const std::int64_t> readings() const noexcept;
  std::span<const ReplayedAnswer> answers() noexcept;

 private:
  explicit ReplayInputReader(vars::ShmFile file);
  vars::ShmFile file_;
  std::vector<ReplayedAnswer> answers_;  // space for as many as a run can have
};

}  // namespace indurop::tape
