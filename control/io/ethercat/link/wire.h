// SPDX-License-Identifier: Apache-2.0
// The wire of a bus as a configuration names it: one network interface, or the two of a ring, "eth1,eth2".

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "control/io/ethercat/link/packet_link.h"
#include "control/io/ethercat/link/ring_link.h"

namespace indurop::io::ethercat {

class Wire {
 public:
  // Errors are those of PacketLink::open(). Not real-time safe.
  static Result<std::unique_ptr<Wire>, std::string> open(const std::string& address);

  [[nodiscard]] Link& link() noexcept { return ring_ ? static_cast<Link&>(*ring_) : *ends_[0]; }
  [[nodiscard]] bool is_ring() const noexcept { return ring_.has_value(); }
  // Where the ring is cut; nothing if it is whole, or no ring. Belongs to who uses the link.
  [[nodiscard]] std::optional<RingLink::Cut> cut() const noexcept { return ring_ ? ring_->cut() : std::nullopt; }
  // Whether one of the interfaces sees a device. Not real-time safe.
  [[nodiscard]] bool has_carrier() const noexcept;
  // Waits until each interface has a frame, for each at most so long. Not real-time safe.
  void wait(Clock at_most) noexcept;

 private:
  Wire() = default;

  std::array<std::unique_ptr<PacketLink>, 2> ends_;  // the second one of a ring only
  std::optional<RingLink> ring_;
};

}  // namespace indurop::io::ethercat
