// SPDX-License-Identifier: Apache-2.0
// What tools are shown about a board's external plane: a shared-memory file like that of the mirror. No DDS here.

#pragma once

#include "mirror/frames/mirror_block.h"

namespace indurop::mirror {

inline constexpr std::uint64_t kExternalMagic = 0x3145525544444e49ULL;  // "INDDURE1"
inline constexpr std::uint32_t kExternalAbi = 1;

struct ExternalBlock {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::int32_t domain;
  std::uint32_t topics;    // variables shown
  std::uint32_t writable;  // of them, those that may be set from outside
  std::atomic<Network> network;
  std::atomic<std::uint32_t> read;            // topics somebody reads
  std::atomic<std::uint64_t> samples;         // published
  std::atomic<std::uint64_t> refused_by_dds;  // values that no sample of their type can hold
  std::atomic<std::uint64_t> received;        // taken over into the store
  std::atomic<std::uint64_t> refused;         // from outside: out of range, or the store was busy
  std::atomic<std::uint64_t> mismatched;      // readers and writers of another type or with a QoS that cannot be kept
  std::atomic<std::int64_t> cycle_max_ns;     // longest look at all variables
  base::SharedText problem;                   // why the network is not there, or what is wrong with the last value
};

}  // namespace indurop::mirror
