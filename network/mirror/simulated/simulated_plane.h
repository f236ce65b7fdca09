// SPDX-License-Identifier: Apache-2.0
// The plane of a board in a simulated plant: the simulator of the network takes what it sends and passes in what
// arrives. Without threads: everything runs in one.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "network/mirror/frames/exchange.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/simulated/message.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class SimulatedPlane final : public Plane {
 public:
  // `boards`: all boards of the plant, in the manifest's order; `own` is the index of this one. `store`, whose time is
  // used, is borrowed until the end.
  SimulatedPlane(std::vector<std::string> boards, std::size_t own, const vars::Store& store);

  // Returns what was sent since the last call.
  std::vector<Message> take_sent() { return std::exchange(sent_, {}); }
  // A message arrived now. `exchange` is what was opened with this plane.
  void arrived(const Message& message, Exchange& exchange);

  Opened offer_frames(Stream stream) override;
  Opened offer_catalogue() override;
  Opened exchange_beacons(BeaconListener& listener) override;
  Result<std::unique_ptr<Subscription>, base::Problem> subscribe(const std::string& board, Stream stream,
                                                                 FrameListener& listener) override;
  void close() noexcept override;
  bool send(const indurop_wire_Frame& frame, Stream stream) noexcept override;
  bool send(const indurop_wire_Catalogue& catalogue) noexcept override;
  bool send(const indurop_wire_Beacon& beacon) noexcept override;

 private:
  class PlaneSubscription;
  void put(Message::Kind kind, std::uint32_t part, std::vector<std::uint8_t> body);

  std::vector<std::string> boards_;
  std::uint32_t own_;
  const vars::Store& store_;
  std::vector<Message> sent_;
  std::vector<std::array<FrameListener*, kStreams>> listeners_;  // by board
  BeaconListener* beacons_ = nullptr;
};

}  // namespace indurop::mirror
