// SPDX-License-Identifier: Apache-2.0
// Twice a second, or less often in a plant of more than 17 boards, every board announces that it is alive, when its
// schedule began, and its estimate of the other boards' clocks.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "network/mirror/frames/clock_compare.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/frames/schedule.h"
#include "network/mirror/frames/settings.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class Beacons final : public BeaconListener {
 public:
  // `store` is borrowed until the end; its time is used.
  Beacons(const vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block);
  Beacons(const Beacons&) = delete;
  Beacons& operator=(const Beacons&) = delete;

  // Returns the time between two beacons such that a board receives and sends at most 32 a second, however many boards
  // there are.
  static std::chrono::nanoseconds interval(std::size_t others) noexcept;

  // `plane` is used until it is closed.
  Plane::Opened open(Plane& plane);
  // Sends a beacon if it is due. Returns when the next is due.
  rt::MonoTime cycle(rt::MonoTime now, const Schedule& schedule) noexcept;

 private:
  struct Peer {
    std::string name;
    std::uint64_t session = 0;
    ClockCompare clock;
  };
  void beacon_came(const indurop_wire_Beacon& beacon) noexcept override;
  void receive_beacon(const indurop_wire_Beacon& beacon, rt::WallTime arrival) noexcept;

  const vars::Store& store_;
  std::string board_;
  std::uint64_t session_;
  MirrorBlock& block_;
  std::mutex mutex_;  // between the receive thread and the manager
  std::vector<Peer> peers_;
  Plane* plane_ = nullptr;
  rt::MonoTime due_{};
};

}  // namespace indurop::mirror
