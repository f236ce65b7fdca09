// SPDX-License-Identifier: Apache-2.0
// Who may write to a node from outside and who forces what: its write lock, and a note for each force, in a file of
// shared memory beside the block. Nothing in a tick looks at it; it stops slips, not somebody with rights who is bent
// on writing. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "vars/held_value.h"
#include "vars/shm_file.h"
#include "vars/store.h"

namespace indurop::vars {

enum class WriteLock : std::uint32_t {
  None,
  Tune,  // parameters alone may be written
  All,   // nothing
};
const char* word_of(WriteLock lock) noexcept;  // "tune"
std::optional<WriteLock> write_lock_of(std::string_view word) noexcept;

// Who did it and why; texts are cut to 63 bytes (reason: 159).
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
  bool lease = false;  // it ends with whoever forces
};

// What somebody outside wants to do.
enum class Act { SetParameter, Set, Force, Command };
// Why the lock forbids it, and what to do; nothing if it does not.
std::optional<std::string> refusal(const LockNote& lock, Act act);

std::string custody_file(const std::string& node);  // indurop.<node>.custody

class Custody {
 public:
  // For a run of a node: the lock of the run before stays, notes of forces go. Errors: as of ShmFile::create, System.
  static Result<Custody> create(const std::string& node);
  // Errors: NotFound (no node of this version ran), as of ShmFile::open.
  static Result<Custody> open(const std::string& node, Mode mode);

  [[nodiscard]] LockNote lock() const;
  // Errors: Busy (somebody who changes it is stopped), PermissionDenied (read-only).
  Status set_lock(const LockNote& note);

  // vars::hold() with a note about each part that is there before its force: no force is seen without who made it.
  // Notes of what is no longer forced make room. Where somebody who writes notes is stopped, the values are held
  // without. Errors: PermissionDenied (read-only), those of vars::hold(); the notes are then as they were.
  Status hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until, const ForceNote& note);
  [[nodiscard]] std::optional<ForceNote> note_of(const DirectoryEntry& variable, std::uint32_t offset) const;

 private:
  explicit Custody(ShmFile file) noexcept : file_(std::move(file)) {}
  ShmFile file_;
};

// As Custody::hold() of the node; without notes if no node of this version ran.
Status hold(const std::string& node, Store& store, std::span<const HeldValue> values, rt::MonoTime until,
            const ForceNote& note);

// None if no node of this version ran.
LockNote lock_of(const std::string& node);

}  // namespace indurop::vars
