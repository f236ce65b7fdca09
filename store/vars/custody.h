// SPDX-License-Identifier: Apache-2.0
// Which external users may write to a node, and who forces which variable: its write lock, and a note for each force,
// in a file of shared memory next to the block. No tick reads it; it prevents mistakes, not deliberate writes by a user
// with rights. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "store/vars/held_value.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::vars {

enum class WriteLock : std::uint32_t {
  None,
  Tune,  // only parameters may be written
  All,   // nothing may be written
};
const char* word_of(WriteLock lock) noexcept;  // "tune"
std::optional<WriteLock> write_lock_of(std::string_view word) noexcept;

// Who made a change and why; texts are cut to 63 bytes (reason: 159).
struct Note {
  std::string who;
  std::string from;
  std::string reason;
  std::int64_t wall_ns = 0;  // CLOCK_REALTIME
};

struct LockNote : Note {
  WriteLock lock = WriteLock::None;
};

struct ForceNote : Note {
  bool lease = false;  // it ends with the process that forces
};

// An action requested from outside the node.
enum class Act { SetParameter, Set, Force, Command };
// Returns why the lock forbids it, and what to do; nothing if it is allowed.
std::optional<std::string> refusal(const LockNote& lock, Act act);

std::string custody_file(const std::string& node);  // indurop.<node>.custody

class Custody {
 public:
  // Creates the file for a run of a node: keeps the lock of the previous run, removes notes of forces. Errors: as of
  // ShmFile::create, System.
  static Result<Custody> create(const std::string& node);
  // Errors: NotFound (no node of this version ran), as of ShmFile::open.
  static Result<Custody> open(const std::string& node, Mode mode);

  [[nodiscard]] LockNote lock() const;
  // Errors: Busy (a process that changes it is stopped), PermissionDenied (read-only).
  Status set_lock(const LockNote& note);

  // Like vars::hold(), with a note about each part that is written before its force: no force is visible without its
  // author. Notes of parts that are no longer forced are overwritten. If a process that writes notes is stopped, the
  // values are held without notes. Errors: PermissionDenied (read-only), those of vars::hold(); the notes are then
  // unchanged.
  Status hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until, const ForceNote& note);
  [[nodiscard]] std::optional<ForceNote> note_of(const DirectoryEntry& variable, std::uint32_t offset) const;

 private:
  explicit Custody(ShmFile file) noexcept : file_(std::move(file)) {}
  ShmFile file_;
};

// Like Custody::hold() of the node; without notes if no node of this version ran.
Status hold(const std::string& node, Store& store, std::span<const HeldValue> values, rt::MonoTime until,
            const ForceNote& note);

// Returns no lock if no node of this version ran.
LockNote lock_of(const std::string& node);

}  // namespace indurop::vars
