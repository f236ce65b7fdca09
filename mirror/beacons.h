// SPDX-License-Identifier: Apache-2.0
// Twice a second every board says that it lives, when its schedule began and what it thinks of the others' clocks.

#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "mirror/clock_compare.h"
#include "mirror/endpoint.h"
#include "mirror/mirror_block.h"
#include "mirror/schedule.h"
#include "mirror/settings.h"
#include "wire.h"

namespace indurop::mirror {

class Beacons {
 public:
  Beacons(const Settings& settings, std::uint64_t session, MirrorBlock& block);
  Beacons(const Beacons&) = delete;
  Beacons& operator=(const Beacons&) = delete;

  // False: `problem` says why.
  bool open(dds_entity_t participant, const Settings& settings, std::string& problem);
  void close() noexcept;
  // Sends one if it is time. Returns when the next is due, CLOCK_MONOTONIC.
  std::int64_t cycle(std::int64_t now_ns, const Schedule& schedule) noexcept;

 private:
  struct Peer {
    std::string name;
    std::uint64_t session = 0;
    ClockCompare clock;
  };
  static void on_data(dds_entity_t reader, void* self);
  void take(dds_entity_t reader) noexcept;
  void heard(const indurop_wire_Beacon& beacon, std::int64_t arrival_ns) noexcept;

  std::string board_;
  std::uint64_t session_;
  MirrorBlock& block_;
  std::mutex mutex_;  // between the receive thread and the manager
  std::vector<Peer> peers_;
  Endpoint writer_;
  Endpoint reader_;
  std::int64_t due_ns_ = 0;
};

}  // namespace indurop::mirror
