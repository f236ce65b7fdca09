// SPDX-License-Identifier: Apache-2.0
// Bytes of the store's block: header, directory sorted by name hash, schema text, variable entries, call slots; behind
// them what the store has grown by while its node runs. Any change here requires a new abi::kVersion, or another size
// of the header.

#pragma once

#include <indurop/detail/abi.h>

#include <atomic>
#include <cstdint>
#include <type_traits>

#include "core/rt/clock.h"

namespace indurop::vars {

inline constexpr std::uint64_t kMagic = 0x31504f5255444e49ULL;  // "INDUROP1"
inline constexpr std::size_t kMaxNodeName = 48;

constexpr std::uint64_t round_up(std::uint64_t value, std::uint64_t to) noexcept {
  return (value + to - 1) / to * to;
}

enum class BlockState : std::uint32_t { Building = 0, Ready = 1, Retired = 2 };

// A forced part of a variable, whose writers are ignored; see store/vars/forces.h.
struct ForceSlot {
  std::atomic<std::uint64_t> version;  // odd while it is being filled
  std::atomic<std::int64_t> entry;     // bytes from here to the variable's entry, 0: free
  std::atomic<std::uint64_t> where;    // offset of the part << 32 | its size
  std::atomic<std::uint64_t> value;    // first bytes of it
  std::atomic<std::int64_t> until_ns;  // CLOCK_MONOTONIC, INT64_MAX: until it is released
};
inline constexpr std::size_t kMaxForces = 64;
struct ForceTable {
  abi::SharedMutex lock;  // for processes that change the table
  ForceSlot slots[kMaxForces];
};

// What a store has since it grew: a directory, which begins with the entries that were there before, and a schema.
struct Catalog {
  std::uint64_t layout_hash;
  std::uint64_t total_size;  // of the block, up to the end of what the catalog names
  std::uint64_t directory_offset;
  std::uint64_t schema_offset;
  std::uint64_t schema_size;
  std::uint64_t variable_count;
};
inline constexpr std::size_t kCatalogs = 2;  // the present one and the next one

struct BlockHeader {
  std::atomic<std::uint64_t> magic;  // stored last, when the block is complete
  std::uint32_t abi;
  std::uint32_t header_size;
  std::uint64_t total_size;   // this and all other values that are not atomic: when the block was created
  std::uint64_t layout_hash;  // over directory and schema text
  std::atomic<std::uint64_t> generation;
  std::atomic<BlockState> state;
  std::atomic<std::int32_t> node_pid;          // 0: no node runs
  std::atomic<std::uint64_t> node_start_time;  // field 22 of /proc/PID/stat, detects a reused pid
  std::atomic<std::int64_t> heartbeat_ns;      // CLOCK_MONOTONIC
  std::atomic<std::int64_t> virtual_ns;        // time of the node's simulation; 0: it runs in real time
  std::uint32_t variable_count;
  std::uint32_t function_count;
  std::uint64_t directory_offset;
  std::uint64_t schema_offset;
  std::uint64_t schema_size;
  std::uint64_t
      functions_offset;  // area of store/vars/call_layout.h: call_area_size(schema) bytes, init_call_area() fills it
  char node_name[kMaxNodeName];
  std::atomic<std::uint64_t> growths;  // the present catalog is catalogs[growths % kCatalogs]; 0: see above
  Catalog catalogs[kCatalogs];
  ForceTable forces;
};

// The growth with which another place got the name of this entry, because the type of the variable changed; 0: none.
inline std::atomic<std::uint64_t>& moved_of(void* entry, abi::Kind kind) noexcept {
  constexpr std::size_t kScalarWord = 5;  // behind those that include/indurop/detail/abi.h uses
  if (kind == abi::Kind::Ring) {
    return reinterpret_cast<std::atomic<std::uint64_t>&>(static_cast<abi::RingHeader*>(entry)->reserved[0]);
  }
  return static_cast<std::atomic<std::uint64_t>*>(entry)[kScalarWord];
}

// The time of the node, which forces, ages and modules use. Real-time safe.
inline rt::MonoTime time_of(const BlockHeader& header) noexcept {
  const std::int64_t simulated = header.virtual_ns.load(std::memory_order_relaxed);
  return simulated != 0 ? rt::mono_time(simulated) : rt::MonoClock::now();
}

struct DirectoryEntry {
  std::uint64_t name_hash;
  std::uint64_t type_hash;
  std::uint64_t offset;  // of the entry from the block's start
  std::uint32_t value_size;
  abi::Kind kind;
  std::uint32_t schema_index;  // into Schema::variables
  std::uint32_t flags;         // kRetain
};
inline constexpr std::uint32_t kRetain = 1;
static_assert(std::is_trivially_copyable_v<DirectoryEntry>);

}  // namespace indurop::vars
