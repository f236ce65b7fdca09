// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/simulated/simulated_plane.h"

#include <algorithm>
#include <utility>

#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {

class SimulatedPlane::PlaneSubscription final : public Subscription {
 public:
  explicit PlaneSubscription(FrameListener*& place) noexcept : place_(place) {}
  ~PlaneSubscription() override { place_ = nullptr; }

 private:
  FrameListener*& place_;
};

SimulatedPlane::SimulatedPlane(std::vector<std::string> boards, std::size_t own, const vars::Store& store)
    : boards_(std::move(boards)), own_(static_cast<std::uint32_t>(own)), store_(store), listeners_(boards_.size()) {}

void SimulatedPlane::put(Message::Kind kind, std::uint32_t part, std::vector<std::uint8_t> body) {
  sent_.push_back({kind, own_, part, board_ns(store_), std::move(body)});
}

Plane::Opened SimulatedPlane::offer_frames(Stream /*stream*/) {
  return {};
}

Plane::Opened SimulatedPlane::offer_catalogue() {
  return {};
}

Plane::Opened SimulatedPlane::exchange_beacons(BeaconListener& listener) {
  beacons_ = &listener;
  return {};
}

Result<std::unique_ptr<Subscription>, base::Problem> SimulatedPlane::subscribe(const std::string& board, Stream stream,
                                                                               FrameListener& listener) {
  const auto found = std::find(boards_.begin(), boards_.end(), board);
  if (found == boards_.end()) {
    return base::Problem{"the plant has no board " + board};
  }
  const auto number = static_cast<std::uint32_t>(found - boards_.begin());
  FrameListener*& place = listeners_[number][static_cast<std::size_t>(stream)];
  place = &listener;
  put(Message::Kind::Subscribe, number * static_cast<std::uint32_t>(kStreams) + static_cast<std::uint32_t>(stream), {});
  return std::unique_ptr<Subscription>(std::make_unique<PlaneSubscription>(place));
}

void SimulatedPlane::close() noexcept {
  beacons_ = nullptr;
}

bool SimulatedPlane::send(const indurop_wire_Frame& frame, Stream stream) noexcept {
  put(static_cast<Message::Kind>(stream), frame.part, to_bytes(frame));
  return true;
}

bool SimulatedPlane::send(const indurop_wire_Catalogue& catalogue) noexcept {
  put(Message::Kind::Catalogue, 0, to_bytes(catalogue));
  return true;
}

bool SimulatedPlane::send(const indurop_wire_Beacon& beacon) noexcept {
  put(Message::Kind::Beacon, 0, to_bytes(beacon));
  return true;
}

void SimulatedPlane::arrived(const Message& message, Exchange& exchange) {
  switch (message.kind) {
    case Message::Kind::Prompt:
    case Message::Kind::BestEffort:
    case Message::Kind::Bulk: {
      const auto stream = static_cast<Stream>(message.kind);
      if (FrameListener* listener = listeners_[message.board][static_cast<std::size_t>(stream)]; listener != nullptr) {
        (void)with_frame(message.body, [&](const indurop_wire_Frame& frame) { listener->frame_came(frame, stream); });
      }
      break;
    }
    case Message::Kind::Catalogue:
      (void)with_catalogue(message.body,
                           [&](const indurop_wire_Catalogue& catalogue) { exchange.announced(catalogue); });
      break;
    case Message::Kind::Beacon:
      if (beacons_ != nullptr) {
        (void)with_beacon(message.body, [&](const indurop_wire_Beacon& beacon) { beacons_->beacon_came(beacon); });
      }
      break;
    case Message::Kind::Gone:
      exchange.gone(boards_[message.board]);
      break;
    case Message::Kind::Subscribe:
      break;
  }
}

}  // namespace indurop::mirror
