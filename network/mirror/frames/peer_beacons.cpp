// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/peer_beacons.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/rt/machine.h"
#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {
namespace {

constexpr std::chrono::milliseconds kEvery{500};
constexpr std::chrono::nanoseconds kForEach = std::chrono::nanoseconds{std::chrono::seconds{1}} / 32;

}  // namespace

std::chrono::nanoseconds Beacons::interval(std::size_t others) noexcept {
  return std::max<std::chrono::nanoseconds>(kEvery, static_cast<std::int64_t>(others) * kForEach);
}

Beacons::Beacons(const vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block)
    : store_(store), board_(settings.network.board), session_(session), block_(block) {
  for (const std::string& name : settings.boards) {
    peers_.push_back({name, 0, {}});
  }
}

Plane::Opened Beacons::open(Plane& plane, Life life) {
  plane_ = &plane;
  life_ = std::move(life);
  return plane.exchange_beacons(*this);
}

std::vector<indurop_wire_Heard> Beacons::estimates() {
  std::vector<indurop_wire_Heard> received;
  const std::lock_guard<std::mutex> guard(mutex_);
  for (Peer& peer : peers_) {
    if (peer.clock.has_samples()) {
      received.push_back({peer.name.data(), peer.clock.least_delay()});
    }
  }
  return received;
}

rt::MonoTime Beacons::cycle(rt::MonoTime now, const Schedule& schedule) noexcept {
  if (now < due_) {
    return due_;
  }
  const std::chrono::nanoseconds every = interval(peers_.size());
  const std::chrono::nanoseconds beat = plane_->beat();
  due_ = now + (beat.count() > 0 ? std::min(beat, every) : every);
  std::vector<indurop_wire_Heard> received;
  if (now >= estimates_due_) {
    estimates_due_ = now + every;
    received = estimates();
  }
  const rt::ClockSync sync = rt::clock_sync();
  block_.epoch_wall_ns.store(rt::to_ns(schedule.epoch), std::memory_order_relaxed);
  block_.clock_synchronised.store(sync.synchronised ? 1 : 0, std::memory_order_relaxed);
  block_.clock_error_ns.store(sync.max_error_ns, std::memory_order_relaxed);
  indurop_wire_Beacon beacon{};
  beacon.board = board_.data();
  beacon.session = session_;
  beacon.epoch_ns = rt::to_ns(schedule.epoch);
  beacon.basic_period_ns = schedule.basic.count();
  beacon.macro_period_ns = schedule.macro.count();
  beacon.synchronised = sync.synchronised;
  beacon.heard._length = beacon.heard._maximum = static_cast<std::uint32_t>(received.size());
  beacon.heard._buffer = received.data();
  beacon.source_time_ns = board_wall_ns(store_);
  if (!plane_->send(beacon)) {
    block_.send_errors.fetch_add(1, std::memory_order_relaxed);
  }
  return due_;
}

void Beacons::beacon_came(const indurop_wire_Beacon& beacon) noexcept {
  receive_beacon(beacon, rt::wall_time(board_wall_ns(store_)));
  life_(beacon.board, beacon.session);
}

void Beacons::beacons_ended(const std::string& board) noexcept {
  life_(board, std::nullopt);
}

void Beacons::receive_beacon(const indurop_wire_Beacon& beacon, rt::WallTime arrival) noexcept {
  const std::lock_guard<std::mutex> guard(mutex_);
  const auto found =
      std::find_if(peers_.begin(), peers_.end(), [&](const Peer& peer) { return peer.name == beacon.board; });
  if (found == peers_.end()) {
    return;
  }
  PeerRecord& record = block_.peers()[found - peers_.begin()];
  if (found->session != beacon.session) {
    found->session = beacon.session;
    found->clock.reset();
    record.clock_known.store(0, std::memory_order_relaxed);
  }
  found->clock.arrived((arrival - rt::wall_time(beacon.source_time_ns)).count());
  record.epoch_wall_ns.store(beacon.epoch_ns, std::memory_order_relaxed);
  record.clock_synchronised.store(beacon.synchronised ? 1 : 0, std::memory_order_relaxed);
  for (std::uint32_t i = 0; i < beacon.heard._length; ++i) {
    if (board_ == beacon.heard._buffer[i].board) {
      const ClockCompare::Offset offset = found->clock.offset(beacon.heard._buffer[i].delay_ns);
      record.clock_offset_ns.store(offset.ns, std::memory_order_relaxed);
      record.clock_bound_ns.store(offset.bound, std::memory_order_relaxed);
      record.clock_known.store(1, std::memory_order_release);
    }
  }
}

}  // namespace indurop::mirror
