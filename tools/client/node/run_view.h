// SPDX-License-Identifier: Apache-2.0
// The run block of a node, mapped read-only and checked before it is used: reading can neither disturb the node nor
// crash on a damaged file.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scheduler/quantile.h"
#include "scheduler/run_block.h"
#include "scheduler/words.h"
#include "store/vars/run_file.h"

namespace indurop::tools {

// Entries of the logs as plain values; `number` counts them from 0 since the node's start.
struct SlotSample {
  std::uint64_t number = 0;
  std::uint64_t tick = 0;
  std::uint64_t slot = 0;
  std::uint32_t module = 0;
  std::int64_t release_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
};
struct OverrunSample {
  std::uint64_t number = 0;
  std::uint64_t tick = 0;
  std::uint64_t slot = 0;
  std::uint32_t module = 0;
  std::int64_t own_ns = 0;
  std::int64_t latency_ns = 0;
  std::int32_t previous = -1;
  std::int64_t previous_ns = 0;
  bool started = false;
};

// A message that a module printed with irp::printf, or the node itself.
struct MessageSample {
  std::string who;  // "node": the node
  std::int64_t time_ns = 0;
  std::string text;  // without the line's end
};

class RunView {
 public:
  // Errors: NotFound, PermissionDenied, Corrupt (no run block, or offsets that lead outside the file),
  // VersionMismatch (another version of InduRoP), Busy (the node is still building it).
  static Result<RunView> open(const std::string& node, vars::Mode mode = vars::Mode::ReadOnly);
  // The run block of a remote node at `now_ns` of its CLOCK_MONOTONIC. Errors: Corrupt, VersionMismatch.
  static Result<RunView> from_image(std::string_view bytes, bool alive, std::int64_t now_ns);

  [[nodiscard]] const scheduler::RunBlock& block() const noexcept { return *block_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return checked_.total; }  // bytes of the block
  [[nodiscard]] std::uint32_t module_count() const noexcept { return checked_.module_count; }
  [[nodiscard]] const scheduler::ModuleRecord& module(std::uint32_t index) const noexcept;
  // Needs a block opened read-write: to place commands in (scheduler/module_command.h), nothing else.
  [[nodiscard]] scheduler::ModuleRecord& module_to_command(std::uint32_t index) noexcept;
  // Returns the name for an index found in a log; "?" if it is invalid.
  [[nodiscard]] std::string module_name(std::int64_t index) const;
  // Returns true if this is the run of the process that holds the node's lock.
  [[nodiscard]] bool node_alive() const;
  [[nodiscard]] bool here() const noexcept { return !elsewhere_; }  // true for a node of this machine
  [[nodiscard]] std::int64_t now_ns() const noexcept;               // CLOCK_MONOTONIC of its machine

  // Returns the newest `most` complete entries of the two logs, oldest first; entries overwritten meanwhile are left
  // out.
  [[nodiscard]] std::vector<SlotSample> slot_log(std::uint64_t most) const;
  [[nodiscard]] std::vector<OverrunSample> overrun_log(std::uint64_t most) const;
  // Returns the newest `most` messages of all modules and of the node, oldest first; the newest 64 of each are kept,
  // none in an image. Messages printed meanwhile are left out.
  [[nodiscard]] std::vector<MessageSample> messages(std::size_t most) const;

 private:
  // The checked pointers and sizes, so that no process can change them afterwards.
  struct Checked {
    const scheduler::ModuleRecord* modules = nullptr;
    const scheduler::SlotEntry* slots = nullptr;
    const scheduler::OverrunEntry* overruns = nullptr;
    std::uint64_t total = 0;  // bytes
    std::uint32_t module_count = 0;
    std::uint32_t slot_capacity = 0;
    std::uint32_t overrun_capacity = 0;
  };
  struct Elsewhere {
    bool alive = false;
    std::int64_t now_ns = 0;
  };
  // `memory` begins with the block.
  static Result<RunView> checked(std::shared_ptr<void> memory, std::uint64_t size);
  RunView(std::shared_ptr<void> memory, const Checked& checked) noexcept
      : memory_(std::move(memory)), block_(static_cast<const scheduler::RunBlock*>(memory_.get())), checked_(checked) {}
  static bool check(const scheduler::RunBlock& block, std::uint64_t file_size, Checked& out) noexcept;

  std::shared_ptr<void> memory_;
  std::string node_;  // empty: remote
  const scheduler::RunBlock* block_;
  Checked checked_;
  std::optional<Elsewhere> elsewhere_;
};

// Returns the text in a char array of fixed size, terminated by NUL or not.
template <std::size_t N>
std::string fixed_text(const char (&text)[N]) {
  const std::string_view whole(text, N);
  return std::string(whole.substr(0, whole.find('\0')));
}

}  // namespace indurop::tools
