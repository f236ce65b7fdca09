// SPDX-License-Identifier: Apache-2.0
// The transport of frames, catalogues and beacons between boards: the network, or a simulated one.

#pragma once

#include <indurop/idl/wire.h>
#include <indurop/result.h>

#include <chrono>
#include <memory>
#include <string>

#include "core/base/problem.h"
#include "network/mirror/frames/frame_layout.h"

namespace indurop::mirror {

// Called by the plane's threads.
class FrameListener {
 public:
  virtual ~FrameListener() = default;
  virtual void frame_came(const indurop_wire_Frame& frame, Stream stream) noexcept = 0;
};

class BeaconListener {
 public:
  virtual ~BeaconListener() = default;
  virtual void beacon_came(const indurop_wire_Beacon& beacon) noexcept = 0;
  // No beacon of the board came for the plant's lease, or it left.
  virtual void beacons_ended(const std::string& board) noexcept = 0;
};

// Frames are delivered as long as this object lives; its destructor waits for a listener that is running.
class Subscription {
 public:
  Subscription() = default;
  virtual ~Subscription() = default;
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;
};

class Plane {
 public:
  using Opened = Result<void, base::Problem>;

  Plane() = default;
  virtual ~Plane() = default;
  Plane(const Plane&) = delete;
  Plane& operator=(const Plane&) = delete;

  // To be called before anything is sent. Repeated calls are no error.
  virtual Opened offer_frames(Stream stream) = 0;
  virtual Opened offer_catalogue() = 0;
  // The listener is borrowed until close().
  virtual Opened exchange_beacons(BeaconListener& listener) = 0;
  // Returns the time between beacons by which the plane notices that a board is silent; zero: it needs none.
  [[nodiscard]] virtual std::chrono::nanoseconds beat() const noexcept { return {}; }
  // A late joiner gets the last frame of each part. The listener is borrowed until the subscription ends.
  virtual Result<std::unique_ptr<Subscription>, base::Problem> subscribe(const std::string& board, Stream stream,
                                                                         FrameListener& listener) = 0;
  // Withdraws all offers and receives no more beacons.
  virtual void close() noexcept = 0;

  // Returns false if it was not sent.
  virtual bool send(const indurop_wire_Frame& frame, Stream stream) noexcept = 0;
  virtual bool send(const indurop_wire_Catalogue& catalogue) noexcept = 0;
  virtual bool send(const indurop_wire_Beacon& beacon) noexcept = 0;
};

}  // namespace indurop::mirror
