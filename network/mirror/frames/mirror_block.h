// SPDX-License-Identifier: Apache-2.0
// The status of a board's mirror for tools: a shared-memory file like the run block. The mirror's threads write it
// without waiting, any process may read it. Without DDS.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "core/base/shared_text.h"

namespace indurop::mirror {

inline constexpr std::uint64_t kMirrorMagic = 0x314d5255444e4931ULL;  // "1INDURM1"
inline constexpr std::uint32_t kMirrorAbi = 3;
inline constexpr std::size_t kBoardName = 48;

enum class Network : std::uint32_t { Connecting, Up };

enum class PeerState : std::uint32_t {
  Absent,      // never received
  Alive,       // its values arrive
  Mismatched,  // present, but its variables differ from those this board's modules were built for; see problem
  Silent,      // was present, nothing received for a lease
};
const char* to_text(PeerState state) noexcept;

// Shared memory is zero before it is filled.
// NOLINTBEGIN(cppcoreguidelines-pro-type-member-init)

// Another board of the plant.
struct PeerRecord {
  char name[kBoardName];
  std::atomic<std::uint32_t> wanted;  // variables this board reads from it
  std::atomic<PeerState> state;
  std::atomic<std::uint64_t> session;       // of its current run, see MirrorBlock
  std::atomic<std::int64_t> heard_ns;       // CLOCK_MONOTONIC of its last frame, 0: none
  std::atomic<std::uint64_t> frames;        // accepted
  std::atomic<std::uint64_t> values;        // written to the store because they differed
  std::atomic<std::uint64_t> lost_updates;  // superseded or lost before they came
  std::atomic<std::uint64_t> refused;       // frames with another layout, or truncated
  std::atomic<std::uint64_t> busy;  // values not written because a local lock was not free; the next frame repeats them
  std::atomic<std::uint64_t> losses;          // how often it fell silent
  std::atomic<std::int64_t> delay_ns;         // CLOCK_REALTIME of this board minus sender's stamp, of the last frame
  std::atomic<std::uint64_t> tick;            // of the sender
  std::atomic<std::int64_t> epoch_wall_ns;    // the sender's CLOCK_REALTIME at its tick 0, 0: no schedule
  std::atomic<std::int64_t> clock_offset_ns;  // own clock minus the peer's, plus or minus the bound
  std::atomic<std::int64_t> clock_bound_ns;
  std::atomic<std::uint32_t> clock_known;         // 1: offset and bound are measured
  std::atomic<std::uint32_t> clock_synchronised;  // 1: it reports that its clock is synchronized
  base::SharedText problem;
};

// A variable that this board reads from another one. Its age is in the store: abi::confirmed_of().
struct IncomingRecord {
  std::atomic<std::uint64_t> name_hash;  // 0: no longer read
  std::atomic<std::uint32_t> peer;       // index of its owner
  std::uint32_t reserved;
};

struct MirrorBlock {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::uint32_t peer_count;
  char plant[kBoardName];
  char board[kBoardName];
  std::int32_t domain;
  // The three grow when the node gets other routes.
  std::atomic<std::uint32_t> outgoing;  // variables sent
  std::atomic<std::uint32_t> parts;     // frames they take
  std::atomic<std::uint32_t> incoming;  // records of variables received
  // CLOCK_REALTIME at the start of this run; the board with the smallest value has served longest.
  std::atomic<std::uint64_t> session;
  std::atomic<Network> network;
  std::atomic<std::uint64_t> updates;  // number of times something was sent
  std::atomic<std::uint64_t> frames;
  std::atomic<std::uint64_t> bytes;
  std::atomic<std::uint64_t> send_errors;
  std::atomic<std::uint64_t> dds_messages;  // warnings and errors of DDS
  std::atomic<std::int64_t> cycle_ns;       // duration of the last check and send
  std::atomic<std::int64_t> cycle_max_ns;
  std::atomic<std::int64_t> epoch_wall_ns;        // CLOCK_REALTIME of tick 0, 0: no schedule
  std::atomic<std::int64_t> clock_error_ns;       // the kernel's estimate
  std::atomic<std::uint32_t> clock_synchronised;  // 1: kept by PTP, NTP or the like
  base::SharedText problem;

  PeerRecord* peers() noexcept { return reinterpret_cast<PeerRecord*>(this + 1); }
  const PeerRecord* peers() const noexcept { return reinterpret_cast<const PeerRecord*>(this + 1); }
  IncomingRecord* variables() noexcept { return reinterpret_cast<IncomingRecord*>(peers() + peer_count); }
  const IncomingRecord* variables() const noexcept {
    return reinterpret_cast<const IncomingRecord*>(peers() + peer_count);
  }
};
// NOLINTEND(cppcoreguidelines-pro-type-member-init)
static_assert(sizeof(MirrorBlock) % alignof(PeerRecord) == 0 && sizeof(PeerRecord) % alignof(IncomingRecord) == 0);

// Records that a node may add while it runs.
inline constexpr std::size_t kMoreIncoming = 1024;

inline constexpr std::size_t mirror_block_size(std::size_t peers, std::size_t incoming) noexcept {
  return sizeof(MirrorBlock) + peers * sizeof(PeerRecord) + incoming * sizeof(IncomingRecord);
}

// Returns the block in a file's memory; null if there is none of this version, or the file is shorter than its counts
// require.
const MirrorBlock* mirror_block_in(std::span<const std::byte> memory) noexcept;

}  // namespace indurop::mirror
