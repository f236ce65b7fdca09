// SPDX-License-Identifier: Apache-2.0
// The shared memory layout of one variable, and the table through which a module finds it. Shared by generated headers,
// libindurop and the store: any change here requires a new kVersion.

#pragma once

#include <indurop/detail/shared_mutex.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace indurop::abi {

inline constexpr std::uint32_t kVersion = 5;

enum class Kind : std::uint32_t {
  Scalar = 0,  // one value of 1, 2, 4 or 8 bytes, an atomic at the entry's first byte
  Ring = 1,    // RingHeader followed by kSlots versions of the value
};

inline constexpr std::size_t kSlots = 4;
inline constexpr std::size_t kAlign = 64;  // every entry and every slot starts on a cache line

// Part of the value that a commit changed; lets a small write to a large variable copy only the difference.
struct alignas(8) DirtyRange {
  std::uint32_t offset;
  std::uint32_t length;
};

// Header of a variable of Kind::Ring. Version `seq` is in slot `seq % kSlots`. A writer holds `lock`, prepares slot
// (seq + 1) % kSlots, then stores seq + 1. A writer that dies leaves a slot that was never published.
struct RingHeader {
  std::atomic<std::uint64_t> seq;
  SharedMutex lock;
  std::atomic<std::uint64_t> lost_writes;  // writes abandoned because the lock was not free in time
  std::uint64_t begun;                     // version last begun; not yet seq: that slot is half changed
  DirtyRange dirty[kSlots];                // the bytes changed by the commit that made this slot's version
  std::uint32_t value_size;
  std::uint32_t slot_stride;
  std::atomic<std::int64_t> confirmed_ns;   // see confirmed_of()
  std::atomic<std::int64_t> update_offset;  // see update_offset_of()
  std::atomic<std::uint64_t> update_word;   // see update_word_of()
  std::atomic<std::int64_t> forces_offset;  // see forces_offset_of()
  std::uint64_t reserved[3];
};
static_assert(sizeof(RingHeader) == 192 && std::is_standard_layout_v<RingHeader>);

constexpr std::size_t slot_stride(std::size_t value_size) noexcept {
  return (value_size + kAlign - 1) / kAlign * kAlign;
}
constexpr std::size_t entry_size(Kind kind, std::size_t value_size) noexcept {
  return kind == Kind::Scalar ? kAlign : sizeof(RingHeader) + kSlots * slot_stride(value_size);
}

// Time (CLOCK_MONOTONIC) at which the board that owns a mirrored variable last confirmed its value. 0: this board owns
// it. Negative: the owner has been silent since then; kNeverConfirmed: no value was received yet. Written by the mirror
// only.
inline constexpr std::int64_t kNeverConfirmed = INT64_MIN;
inline std::atomic<std::int64_t>& confirmed_of(void* entry, Kind kind) noexcept {
  if (kind == Kind::Ring) {
    return static_cast<RingHeader*>(entry)->confirmed_ns;
  }
  return static_cast<std::atomic<std::int64_t>*>(entry)[1];  // after the value, on its cache line
}

// Values of one sending board are applied one update at a time; an update word lets readers detect this. Offset in
// bytes from the entry to that word; 0: this board owns the variable; kAlone: it is sent on its own. Written by the
// mirror only.
inline constexpr std::int64_t kAlone = INT64_MIN;
inline std::atomic<std::int64_t>& update_offset_of(void* entry, Kind kind) noexcept {
  if (kind == Kind::Ring) {
    return static_cast<RingHeader*>(entry)->update_offset;
  }
  return static_cast<std::atomic<std::int64_t>*>(entry)[2];
}
// Space for such a word in an entry: the word of a sending board is stored with one of its variables. It counts updates
// in steps of kUpdateStep; its low bits state whether an update is being applied and whether the values are from
// different updates.
inline constexpr std::uint64_t kUpdating = 1;
inline constexpr std::uint64_t kPartial = 2;
inline constexpr std::uint64_t kUpdateStep = 4;
inline std::atomic<std::uint64_t>& update_word_of(void* entry, Kind kind) noexcept {
  if (kind == Kind::Ring) {
    return static_cast<RingHeader*>(entry)->update_word;
  }
  return static_cast<std::atomic<std::uint64_t>*>(entry)[3];
}

// Offset in bytes from the entry to the store's table of forces if a part of this variable may be in it; 0: no part is.
// Writes to a forced part are dropped.
inline std::atomic<std::int64_t>& forces_offset_of(void* entry, Kind kind) noexcept {
  if (kind == Kind::Ring) {
    return static_cast<RingHeader*>(entry)->forces_offset;
  }
  return static_cast<std::atomic<std::int64_t>*>(entry)[4];
}

// One of several variables that are read together.
struct Piece {
  void* entry;
  void* to;  // size bytes
  Kind kind;
  std::uint32_t size;
  std::uint64_t version;  // this and the following fields are private to the reader
  std::int64_t update_offset;
  std::uint64_t update;
};

// One row per declared variable in every .so or executable that includes a generated header. `entry` is set when the
// module is loaded and again when the store is replaced; it is never null after that.
struct Ref {
  std::uint64_t name_hash;  // fnv1a64 of the full name, "knu::Robot::joints"
  std::uint64_t type_hash;  // fnv1a64 of the canonical type text
  void* entry;
  const void* initial;  // value_size bytes, or null for all zero
  std::uint32_t value_size;
  Kind kind;
  const char* name;
};

constexpr std::uint64_t fnv1a64(const char* text, std::size_t length) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < length; ++i) {
    hash = (hash ^ static_cast<unsigned char>(text[i])) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace indurop::abi

// Services of libindurop for the inline code of generated headers. C names: the same symbol for every compiler.
extern "C" {

// Registers `count` rows and binds them: to the store this process is attached to, else to private memory with the
// initial values. Called by a constructor of each module before its own static objects.
void indurop_register_refs(indurop::abi::Ref* refs, std::uint32_t count, std::uint32_t abi_version);
void indurop_unregister_refs(indurop::abi::Ref* refs);

// Takes the writer's lock and returns the slot to fill for bytes [offset, offset + length), everything else in it
// already equal to the current version; null if the lock could not be taken in time (counted). Real-time safe.
void* indurop_begin_write(indurop::abi::RingHeader* ring, std::uint32_t offset, std::uint32_t length) noexcept;
// The same for changes anywhere in the value: the slot returned is a copy of the current version.
void* indurop_begin_edit(indurop::abi::RingHeader* ring) noexcept;
void indurop_commit_write(indurop::abi::RingHeader* ring) noexcept;
void indurop_abort_write(indurop::abi::RingHeader* ring) noexcept;

// For a scalar that may be forced: returns true if it is, after setting it to the forced value. Real-time safe.
bool indurop_hold_scalar(void* entry) noexcept;

// Copies part of the current version after the lock-free read failed 16 times. Real-time safe.
void indurop_read_slow(const indurop::abi::RingHeader* ring, void* to, std::uint32_t offset,
                       std::uint32_t length) noexcept;

// Copies whole variables that belong together: at one moment on the board that owns them, after one update of the board
// that sends them. Returns false if that was not possible: then each value is consistent, but they need not belong
// together. Real-time safe.
bool indurop_read_together(indurop::abi::Piece* pieces, std::uint32_t count) noexcept;

// Throws std::out_of_range naming variable, index and bound.
[[noreturn]] void indurop_index_fault(const char* variable, std::uint64_t index, std::uint64_t bound);
}
