// SPDX-License-Identifier: Apache-2.0
// One datagram that a part of the master wants to send outside of the process data, and the wire under the master.

#pragma once

#include <chrono>
#include <cstdint>

#include "control/io/ethercat/frame.h"
#include "control/io/ethercat/registers.h"

namespace indurop::io::ethercat {

using Clock = std::chrono::nanoseconds;  // monotonic, real or virtual

struct Query {
  Command command = Command::Nop;
  std::uint32_t address = 0;
  Bytes data;              // to write; lives until the answer
  std::size_t length = 0;  // to read, without data
};

// Locally given, so that the first slave's mark in it changes nothing.
inline constexpr Mac kMasterMac = {0x02, 0x49, 0x52, 0x50, 0, 0x01};

// Of a slave in its state machine: AL status, and its code at kStateCodeAt.
inline constexpr std::size_t kStateBytes = 6;
inline constexpr std::size_t kStateCodeAt = 4;
inline Query state_query(std::uint16_t station) noexcept {
  return {Command::Fprd, address_of(station, reg::kAlStatus), {}, kStateBytes};
}

// The wire: sends and receives whole Ethernet frames, never waits.
class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;
  virtual bool send(Bytes frame) noexcept = 0;
  // Returns the size of a frame that arrived, 0 if there is none.
  virtual std::size_t receive(std::span<std::uint8_t> to) noexcept = 0;
};

// What can happen to a slave. The number after it in an Event says more.
enum class Problem : std::uint8_t {
  None,
  Missing,        // no answer at its position
  Moved,          // another slave of the configuration answers there
  WrongIdentity,  // product code that was found
  WrongAlias,     // alias that was found
  EepromBusy,
  StateRefused,   // AL status code
  StateTimeout,   // requested state
  StateLost,      // left OP on its own: AL status code
  SdoAborted,     // abort code
  SdoTimeout,     // index of the object
  WrongCounter,   // working counter that came
  EmergencySent,  // error code
  NoClock,
  NoLrw,          // was exchanged for one that does not run the command that its process data is planned with
  BrokenFrames,   // number of the port * 65536 + how many in the last second
  LostLink,       // the same of its link
  CopyBegun,      // gets bits of another slave: the place of that one
  CopyLost,       // that one has no valid ones any more: its place
  ClockNotInStep  // how far it is ahead of the reference, ns, as a signed number
};

struct Event {
  Clock time{0};
  std::uint16_t slave = 0;  // its place in the configuration
  Problem problem = Problem::None;
  std::uint32_t detail = 0;
  std::uint32_t object = 0;  // of SdoAborted: index and subindex, 0x607100
};

}  // namespace indurop::io::ethercat
