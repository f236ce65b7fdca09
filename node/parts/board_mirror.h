// SPDX-License-Identifier: Apache-2.0
// This board's mirror: in the network, in a simulated plant, or none.

#pragma once

#include <cstdint>
#include <memory>

#include "node/run/checked.h"
#include "node/run/options.h"
#include "node/run/prepared.h"
#include "node/simulate/running_mirror.h"
#include "node/simulate/simulation.h"

namespace indurop::node {

class BoardMirror {
 public:
  // All arguments are borrowed.
  BoardMirror(const Options& options, Checked& checked, Prepared& prepared, const Console& console)
      : options_(options), checked_(checked), prepared_(prepared), console_(console) {}

  // Starts no mirror for a module.xml, nor in the simulation of one board. `simulation` null: in real time.
  Result<void, Ending> start(Simulation* simulation);
  // Announces when the schedule began in real time, whenever it is another one. Called after the first has begun.
  void announce() noexcept;
  // Called when the store may have changed. Real-time safe.
  void notify() noexcept;
  // Exchanges this from now on, see mirror::Exchange::follow().
  void follow(const mirror::Routes& routes);
  [[nodiscard]] const mirror::MirrorBlock* block() const noexcept;
  // Stops the mirror; the other boards notice at once that this one is gone.
  void stop() noexcept;

 private:
  Result<void, Ending> start_in_network();
  Result<void, Ending> start_simulated(Simulation& simulation);

  const Options& options_;
  Checked& checked_;
  Prepared& prepared_;
  const Console& console_;
  std::unique_ptr<RunningMirror> running_;  // null: none
  std::uint64_t announced_ = 0;             // number of the schedule that the other boards know
};

}  // namespace indurop::node
