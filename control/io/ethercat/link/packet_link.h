// SPDX-License-Identifier: Apache-2.0
// The wire at a network interface: a raw socket for frames of EtherCAT only.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <utility>

#include "control/io/ethercat/master/query.h"
#include "core/rt/packet_socket.h"

namespace indurop::io::ethercat {

class PacketLink final : public Link {
 public:
  // Errors say what is missing: the right to raw sockets, the interface, or that it is switched off. Not real-time
  // safe.
  static Result<std::unique_ptr<PacketLink>, std::string> open(const std::string& interface);

  bool send(Bytes frame) noexcept override { return socket_->send(frame); }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override { return socket_->receive(to); }

  // Returns whether the interface sees a device at the other end of its cable. Not real-time safe.
  [[nodiscard]] bool has_carrier() const noexcept { return socket_->has_carrier(); }
  // Waits until a frame is there, at most so long; returns whether one is. Not real-time safe.
  bool wait(Clock at_most) noexcept { return socket_->wait(at_most); }

 private:
  explicit PacketLink(std::unique_ptr<rt::PacketSocket> socket) : socket_(std::move(socket)) {}

  std::unique_ptr<rt::PacketSocket> socket_;
};

}  // namespace indurop::io::ethercat
