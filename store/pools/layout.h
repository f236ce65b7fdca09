// SPDX-License-Identifier: Apache-2.0
// Layout of a pool's file: header, seats of the modules and programs that use it, states of the chunks, who holds
// which chunk, then the chunks. Nothing here is a count that a killed process could leave wrong: each word is either
// one atomic step of the pool or belongs to one seat, which is cleared when its process is gone. Any change here
// requires a new kPoolAbi.

#pragma once

#include <indurop/detail/shared_mutex.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace indurop::pools {

// A test lets other users of the pool run before each access.
#ifdef INDUROP_POOL_ATOMIC
template <class T>
using Atomic = INDUROP_POOL_ATOMIC<T>;
#else
template <class T>
using Atomic = std::atomic<T>;
#endif

inline constexpr std::uint64_t kPoolMagic = 0x314c4f4f50444e49ULL;  // "INDPOOL1"
inline constexpr std::uint32_t kPoolAbi = 1;

inline constexpr std::uint32_t kMinChunks = 2;  // the newest one and one to fill
inline constexpr std::uint32_t kMaxChunks = 64;
inline constexpr std::uint32_t kSeats = 32;
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{256} << 20U;
inline constexpr std::size_t kMaxPoolName = 256;
inline constexpr std::size_t kMaxUserName = 48;
inline constexpr std::size_t kPoolLine = 64;  // bytes of a cache line

// The state of a chunk is one word: its phase, with the seat that fills it, or with its number. Numbers count
// published chunks from 1 and are never used again.
enum class Phase : std::uint8_t { Free = 0, Filling = 1, Published = 2 };
inline constexpr std::uint64_t kFree = 0;
constexpr std::uint64_t filled_by(std::uint32_t seat) noexcept {
  return std::uint64_t{seat} << 8U | static_cast<std::uint64_t>(Phase::Filling);
}
constexpr std::uint64_t published_as(std::uint64_t number) noexcept {
  return number << 16U | static_cast<std::uint64_t>(Phase::Published);
}
constexpr Phase phase_of(std::uint64_t state) noexcept {
  return static_cast<Phase>(state & 0xFFU);
}
// Of a published chunk; 0 of others.
constexpr std::uint64_t number_of(std::uint64_t state) noexcept {
  return state >> 16U;
}

// A module or program that uses the pool. Only it changes the counters.
struct alignas(kPoolLine) Seat {
  Atomic<std::int32_t> pid;               // 0: free
  Atomic<std::uint64_t> start_time;       // field 22 of /proc/PID/stat
  Atomic<std::uint64_t> seen;             // highest number it has taken
  Atomic<std::uint64_t> missed;           // chunks that next() did not get, because they were used again
  Atomic<std::uint64_t> published;        // chunks that it has published
  Atomic<std::uint64_t> without_a_chunk;  // takes that found no free chunk
  char user[kMaxUserName];
};

struct PoolHeader {
  Atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::uint32_t chunk_count;
  std::uint64_t chunk_bytes;
  std::uint64_t stride;  // bytes from chunk to chunk
  std::uint64_t data_offset;
  std::uint64_t type_hash;
  Atomic<std::uint32_t> retired;  // 1: the node has another file for this pool, or none
  char name[kMaxPoolName];
  abi::SharedMutex lock;                             // of the seats; no module takes it while it runs
  alignas(kPoolLine) Atomic<std::uint64_t> numbers;  // numbers given so far
  Atomic<std::uint64_t> missed;                      // sums over all seats there ever were
  Atomic<std::uint64_t> without_a_chunk;
  Atomic<std::uint64_t> recovered;  // chunks found in the hand of processes that were gone
  Seat seats[kSeats];
  alignas(kPoolLine) Atomic<std::uint64_t> states[kMaxChunks];
  Atomic<std::int64_t> published_ns[kMaxChunks];                       // in the node's time
  alignas(kPoolLine) Atomic<std::uint32_t> holds[kMaxChunks][kSeats];  // how often a seat has it in its hand
};
static_assert(Atomic<std::uint64_t>::is_always_lock_free && std::is_standard_layout_v<PoolHeader>);

}  // namespace indurop::pools
