// SPDX-License-Identifier: Apache-2.0
// Twice a second every board says that it lives, when its schedule began and what it thinks of the others' clocks.

#pragma once

#include <indurop/idl/wire.h>
#include <indurop/result.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "base/problem.h"
#include "dds/endpoint.h"
#include "mirror/frames/clock_compare.h"
#include "mirror/frames/mirror_block.h"
#include "mirror/frames/schedule.h"
#include "mirror/frames/settings.h"
#include "rt/clock.h"

namespace indurop::mirror {

class Beacons {
 public:
  Beacons(const Settings& settings, std::uint64_t session, MirrorBlock& block);
  Beacons(const Beacons&) = delete;
  Beacons& operator=(const Beacons&) = delete;

  Result<void, base::Problem> open(dds::Handle participant, const Settings& settings);
  void close() noexcept;
  // Sends one if it is time. Returns when the next is due.
  rt::MonoTime cycle(rt::MonoTime now, const Schedule& schedule) noexcept;

 private:
  struct Peer {
    std::string name;
    std::uint64_t session = 0;
    ClockCompare clock;
  };
  static void on_data(dds::Handle reader, void* self);
  void take(dds::Handle reader) noexcept;
  void heard(const indurop_wire_Beacon& beacon, rt::WallTime arrival) noexcept;

  std::string board_;
  std::uint64_t session_;
  MirrorBlock& block_;
  std::mutex mutex_;  // between the receive thread and the manager
  std::vector<Peer> peers_;
  dds::Endpoint writer_;
  dds::Endpoint reader_;
  rt::MonoTime due_{};
};

}  // namespace indurop::mirror
