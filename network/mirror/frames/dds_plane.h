// SPDX-License-Identifier: Apache-2.0
// The plane of boards in a network: one topic for each board and stream (plane_topics.h).

#pragma once

#include <array>
#include <chrono>
#include <string>

#include "network/dds/endpoint.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/frames/settings.h"

namespace indurop::mirror {

class DdsPlane final : public Plane {
 public:
  // `settings` is borrowed until the end.
  explicit DdsPlane(const Settings& settings) : settings_(settings) {}

  // All endpoints opened from now on belong to this participant.
  void enter(dds::Handle participant) noexcept { participant_ = participant; }

  Opened offer_frames(Stream stream) override;
  Opened offer_catalogue() override;
  Opened exchange_beacons(BeaconListener& listener) override;
  [[nodiscard]] std::chrono::nanoseconds beat() const noexcept override;
  Result<std::unique_ptr<Subscription>, base::Problem> subscribe(const std::string& board, Stream stream,
                                                                 FrameListener& listener) override;
  void close() noexcept override;
  bool send(const indurop_wire_Frame& frame, Stream stream) noexcept override;
  bool send(const indurop_wire_Catalogue& catalogue) noexcept override;
  bool send(const indurop_wire_Beacon& beacon) noexcept override;

 private:
  static void on_beacon(dds::Handle reader, void* listener);

  const Settings& settings_;
  dds::Handle participant_{};
  std::array<dds::Endpoint, kStreams> frames_;
  dds::Endpoint catalogue_;
  dds::Endpoint beacons_;
  dds::Endpoint beacon_reader_;  // beacons of other boards
};

}  // namespace indurop::mirror
