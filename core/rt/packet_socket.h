// SPDX-License-Identifier: Apache-2.0
// A raw socket at one network interface, for whole Ethernet frames of one protocol. Frames that arrived are read from
// a ring that the kernel shares, without a system call; sending takes one.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace indurop::rt {

struct PacketProblem {
  enum class Kind { NoRight, NoInterface, SwitchedOff, System } kind = Kind::System;
  int sys_errno = 0;  // of System
};

class PacketSocket {
 public:
  // `protocol`: the EtherType. Not real-time safe.
  static Result<std::unique_ptr<PacketSocket>, PacketProblem> open(const std::string& interface,
                                                                   std::uint16_t protocol);
  PacketSocket(const PacketSocket&) = delete;
  PacketSocket& operator=(const PacketSocket&) = delete;
  ~PacketSocket();

  // Both are real-time safe and never wait. send() returns false if the interface takes no frame: it has no link, or
  // its queue is full. receive() returns the size of the frame, 0 if there is none.
  bool send(std::span<const std::uint8_t> frame) noexcept;
  std::size_t receive(std::span<std::uint8_t> to) noexcept;

  // Returns whether the interface sees a device at the other end of its cable. Not real-time safe.
  [[nodiscard]] bool has_carrier() const noexcept;
  // Waits until a frame is there, at most so long; returns whether one is. Not real-time safe.
  bool wait(std::chrono::nanoseconds at_most) noexcept;

 private:
  PacketSocket(std::string interface, int socket) : interface_(std::move(interface)), socket_(socket) {}
  [[nodiscard]] int share_ring() noexcept;

  std::string interface_;
  int socket_;
  std::uint8_t* ring_ = nullptr;
  std::size_t next_ = 0;  // slot of the ring
};

}  // namespace indurop::rt
