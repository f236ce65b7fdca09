// SPDX-License-Identifier: Apache-2.0
// POSIX has no raw sockets for whole frames.

#include "core/rt/packet_socket.h"

#include <cerrno>

namespace indurop::rt {

Result<std::unique_ptr<PacketSocket>, PacketProblem> PacketSocket::open(const std::string& /*interface*/,
                                                                        std::uint16_t /*protocol*/) {
  return PacketProblem{PacketProblem::Kind::System, ENOTSUP};
}

PacketSocket::~PacketSocket() = default;

bool PacketSocket::send(std::span<const std::uint8_t> /*frame*/) noexcept {
  return false;
}

std::size_t PacketSocket::receive(std::span<std::uint8_t> /*to*/) noexcept {
  return 0;
}

bool PacketSocket::has_carrier() const noexcept {
  return false;
}

bool PacketSocket::wait(std::chrono::nanoseconds /*at_most*/) noexcept {
  return false;
}

}  // namespace indurop::rt
