// SPDX-License-Identifier: Apache-2.0
// The status of a board's external plane for tools: a shared-memory file like that of the mirror. Without DDS.

#pragma once

#include "network/mirror/frames/mirror_block.h"

namespace indurop::mirror {

inline constexpr std::uint64_t kExternalMagic = 0x3145525544444e49ULL;  // "INDDURE1"
inline constexpr std::uint32_t kExternalAbi = 1;

struct ExternalBlock {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::int32_t domain;
  std::uint32_t topics;    // variables published
  std::uint32_t writable;  // variables that may be set from outside
  std::atomic<Network> network;
  std::atomic<std::uint32_t> read;            // topics that have a reader
  std::atomic<std::uint64_t> samples;         // published
  std::atomic<std::uint64_t> refused_by_dds;  // values that do not fit a sample of their type
  std::atomic<std::uint64_t> received;        // values written to the store
  std::atomic<std::uint64_t> refused;         // values from outside: out of range, or the store was busy
  std::atomic<std::uint64_t> mismatched;      // readers and writers with another type or an incompatible QoS
  std::atomic<std::int64_t> cycle_max_ns;     // longest check of all variables
  base::SharedText problem;                   // why the network is not available, or what is wrong with the last value
};

}  // namespace indurop::mirror
