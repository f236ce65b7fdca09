// SPDX-License-Identifier: Apache-2.0
// The wire of a bus and its time. One at network interfaces: one interface, or the two of a ring, "eth1,eth2".

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
  Wire() = default;
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;
  virtual ~Wire() = default;

  [[nodiscard]] virtual Link& link() noexcept = 0;
  // Where the ring is cut; nothing if it is whole, or no ring. Belongs to who uses the link.
  [[nodiscard]] virtual std::optional<RingLink::Cut> cut() const noexcept = 0;
  // Whether one of the interfaces sees a device. Not real-time safe.
  [[nodiscard]] virtual bool has_carrier() const noexcept = 0;
  // Waits until each interface has a frame, for each at most so long. Not real-time safe.
  virtual void wait(Clock at_most) noexcept = 0;
  // What the master's clock shows. It never goes back.
  [[nodiscard]] virtual Clock now() noexcept = 0;
};

class NetworkWire final : public Wire {
 public:
  // Errors are those of PacketLink::open(). Not real-time safe.
  static Result<std::unique_ptr<Wire>, std::string> open(const std::string& address);

  [[nodiscard]] Link& link() noexcept override { return ring_ ? static_cast<Link&>(*ring_) : *ends_[0]; }
  [[nodiscard]] std::optional<RingLink::Cut> cut() const noexcept override {
    return ring_ ? ring_->cut() : std::nullopt;
  }
  [[nodiscard]] bool has_carrier() const noexcept override;
  void wait(Clock at_most) noexcept override;
  [[nodiscard]] Clock now() noexcept override;

 private:
  NetworkWire() = default;

  std::array<std::unique_ptr<PacketLink>, 2> ends_;  // the second one of a ring only
  std::optional<RingLink> ring_;
};

}  // namespace indurop::io::ethercat
