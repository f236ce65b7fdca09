// SPDX-License-Identifier: Apache-2.0
// Every board announces that it is alive, several times in a lease, and when its schedule began; twice a second, or
// less often in a plant of more than 17 boards, also its estimate of the other boards' clocks.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
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

  // Returns the time between two beacons with estimates such that a board receives and sends at most 32 of these a
  // second, however many boards there are.
  static std::chrono::nanoseconds interval(std::size_t others) noexcept;

  // Called by the plane's threads: a board that beacons of `session` came from is alive; without session, silent.
  using Life = std::function<void(const std::string& board, std::optional<std::uint64_t> session)>;
  // `plane` is used until it is closed.
  Plane::Opened open(Plane& plane, Life life);
  // Sends a beacon if it is due. Returns when the next is due.
  rt::MonoTime cycle(rt::MonoTime now, const Schedule& schedule) noexcept;

 private:
  struct Peer {
    std::string name;
    std::uint64_t session = 0;
    ClockCompare clock;
  };
  void beacon_came(const indurop_wire_Beacon& beacon) noexcept override;
  void beacons_ended(const std::string& board) noexcept override;
  std::vector<indurop_wire_Heard> estimates();
  void receive_beacon(const indurop_wire_Beacon& beacon, rt::WallTime arrival) noexcept;

  const vars::Store& store_;
  std::string board_;
  std::uint64_t session_;
  MirrorBlock& block_;
  std::mutex mutex_;  // between the receive thread and the manager
  std::vector<Peer> peers_;
  Plane* plane_ = nullptr;
  Life life_;
  rt::MonoTime due_{};
  rt::MonoTime estimates_due_{};
};

}  // namespace indurop::mirror
