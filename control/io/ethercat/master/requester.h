// SPDX-License-Identifier: Apache-2.0
// One datagram after the other with an answer to each, for programs that ask the slaves of a bus that has no master.
// Waits: not for the tick.

#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class Requester {
 public:
  // Waits until a frame may have come, and returns what time it is then.
  using Wait = std::function<Clock()>;
  Requester(Link& link, Wait wait) : link_(link), wait_(std::move(wait)), builder_(kMasterMac) {}

  struct Answer {
    std::uint16_t wkc = 0;
    std::vector<std::uint8_t> data;
  };
  // Nothing: no answer to any of several tries.
  std::optional<Answer> request(Command command, std::uint32_t address, Bytes data);
  // Of the slave at this position. Nothing: it does not answer.
  std::optional<std::vector<std::uint8_t>> read(std::size_t place, std::uint16_t offset, std::size_t length);
  bool write(std::size_t place, std::uint16_t offset, Bytes data);
  Clock wait() { return wait_(); }

 private:
  Link& link_;
  Wait wait_;
  FrameBuilder builder_;
  std::uint8_t index_ = 0;
};

}  // namespace indurop::io::ethercat
