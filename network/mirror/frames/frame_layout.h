// SPDX-License-Identifier: Apache-2.0
// Assigns variables to parts of the board's frames. A part is sent whole when anything in it has changed, so the last
// frame of each part is always complete: late joiners and lost frames need nothing more. Pure.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace indurop::mirror {

// The way parts are sent: each kind has its own topic and its own writer.
enum class Stream : std::uint32_t {
  Prompt,      // repeated until it has arrived or is superseded
  BestEffort,  // not repeated
  Bulk,        // values too large for one packet: must not delay the others
};
inline constexpr std::size_t kStreams = 3;

inline constexpr std::uint32_t kPartBytes = 1300;  // one packet on Ethernet, with DDS's own headers
inline constexpr std::int64_t kKeepAliveNs = 100'000'000;

struct Parcel {
  std::uint32_t size = 0;
  std::int64_t every_ns = 0;
  std::int64_t maxage_ns = 0;  // 0: none
  bool best_effort = false;
};

struct Placed {
  std::uint32_t parcel = 0;  // index into the input
  std::uint32_t offset = 0;  // in the part's data
};

struct Part {
  Stream stream = Stream::Prompt;
  std::uint32_t size = 0;
  std::int64_t every_ns = 0;      // at most this often
  std::int64_t keepalive_ns = 0;  // at least this often
  std::vector<Placed> content;
};

// Packs parcels in their order into parts; parcels with different rates go to different parts. Part number = index.
std::vector<Part> pack(std::span<const Parcel> parcels);

}  // namespace indurop::mirror
