// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/link/wire.h"

#include <utility>

#include "core/rt/clock.h"

namespace indurop::io::ethercat {

Result<std::unique_ptr<Wire>, std::string> NetworkWire::open(const std::string& address) {
  std::unique_ptr<NetworkWire> wire(new NetworkWire());  // NOLINT: the constructor is private
  const std::size_t comma = address.find(',');
  auto first = PacketLink::open(address.substr(0, comma));
  if (!first) {
    return first.error();
  }
  wire->ends_[0] = std::move(*first);
  if (comma != std::string::npos) {
    auto last = PacketLink::open(address.substr(comma + 1));
    if (!last) {
      return last.error();
    }
    wire->ends_[1] = std::move(*last);
    wire->ring_.emplace(*wire->ends_[0], *wire->ends_[1]);
  }
  return std::unique_ptr<Wire>(std::move(wire));
}

bool NetworkWire::has_carrier() const noexcept {
  return ends_[0]->has_carrier() || (ends_[1] != nullptr && ends_[1]->has_carrier());
}

void NetworkWire::wait(Clock at_most) noexcept {
  for (const auto& end : ends_) {
    if (end != nullptr) {
      end->wait(at_most);
    }
  }
}

Clock NetworkWire::now() noexcept {
  return rt::MonoClock::now().time_since_epoch();
}

}  // namespace indurop::io::ethercat
