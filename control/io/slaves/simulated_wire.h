// SPDX-License-Identifier: Apache-2.0
// The wire of a bus whose slaves are simulated in the virtual time of a node: without sockets, the same in every run.
// Slaves compute what is behind them when time passes.

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "config/model/io_config.h"
#include "control/io/ethercat/link/wire.h"
#include "control/io/ethercat/simulator/bus.h"
#include "control/io/ethercat_wires.h"
#include "control/io/slaves/slave_word.h"
#include "core/base/diagnostic.h"

namespace indurop::io::slaves {

// Virtual time in ns; it never goes back.
using VirtualClock = std::function<std::int64_t()>;

class SimulatedWire final : public ethercat::Wire {
 public:
  SimulatedWire(VirtualClock clock, bool is_ring);

  // Returns what is wrong with its place on the cable, empty: nothing.
  std::string add(SlaveModel model);
  // Times count from the first tick: the first now() after virtual time has passed.
  void set_faults(std::vector<ethercat::Fault> faults) { faults_ = std::move(faults); }

  [[nodiscard]] ethercat::Link& link() noexcept override { return ring_ ? static_cast<ethercat::Link&>(*ring_) : bus_; }
  [[nodiscard]] std::optional<ethercat::RingLink::Cut> cut() const noexcept override {
    return ring_ ? ring_->cut() : std::nullopt;
  }
  [[nodiscard]] bool has_carrier() const noexcept override { return true; }
  // Lets time pass on the bus that does not pass in the node.
  void wait(ethercat::Clock at_most) noexcept override { pass(at_most); }
  [[nodiscard]] ethercat::Clock now() noexcept override;

 private:
  void pass(ethercat::Clock time) noexcept;

  VirtualClock clock_;
  std::int64_t seen_;                    // of the virtual clock
  ethercat::Clock time_{0};              // on the bus
  std::vector<ethercat::Fault> faults_;  // until the first tick
  ethercat::SimulatedBus bus_;
  std::optional<ethercat::RingLink> ring_;
};

// A wire for each bus that the devices name, with the slaves of its <simulation>. Errors: a bus without one, words and
// scripts that cannot be read. Not real-time safe.
Result<EthercatWires, std::vector<base::Diagnostic>> simulated_wires(const config::IoConfig& config,
                                                                     const VirtualClock& clock);

}  // namespace indurop::io::slaves
