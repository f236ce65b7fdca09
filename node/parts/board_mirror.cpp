// SPDX-License-Identifier: Apache-2.0
#include "node/parts/board_mirror.h"

#include <chrono>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "node/run/rights.h"
#include "scheduler/bands.h"

namespace indurop::node {

Result<void, Ending> BoardMirror::start(Simulation* simulation) {
  if (!checked_.mirror || (simulation != nullptr && simulation->place() == nullptr)) {
    return {};
  }
  return simulation == nullptr ? start_in_network() : start_simulated(*simulation);
}

Result<void, Ending> BoardMirror::start_in_network() {
  mirror::Settings& settings = *checked_.mirror;
  const bool realtime = prepared_.rights.realtime();
  settings.network.fifo_priority = realtime ? scheduler::kMirrorPriority : 0;
  // On cores without modules, if there are any.
  const std::vector<int> cores = cores_without_modules(checked_.config, prepared_.rights);
  const auto spin = spin_setting(options_, checked_.config);
  settings.spin = !cores.empty() && spin.mode != config::SpinSetting::Mode::Off && realtime;
  settings.cores = cores.empty() ? rt::allowed_cores() : cores;
  auto started = mirror::Mirror::start(std::move(settings), options_.node, *prepared_.store, prepared_.run().tick);
  if (!started) {
    console_.error("cannot start the mirror to other boards: {}", describe(started.error()));
    return Ending{kFailed};
  }
  mirror_ = std::move(started).value();
  return {};
}

Result<void, Ending> BoardMirror::start_simulated(Simulation& simulation) {
  auto started = SimulatedMirror::start(std::move(*checked_.mirror), options_.node, *simulation.place(),
                                        *prepared_.store, prepared_.run().tick, simulation.kernel());
  if (!started) {
    console_.error("cannot start the mirror to other boards: {}", describe(started.error()));
    return Ending{kFailed};
  }
  simulated_ = std::move(started).value();
  simulation.connect({[this](const mirror::Message& message) { simulated_->arrived(message); },
                      [this] { return simulated_->take_sent(); }});
  return {};
}

void BoardMirror::announce() noexcept {
  const std::chrono::nanoseconds basic{prepared_.setup.basic_period_ns};
  const std::chrono::nanoseconds macro{prepared_.setup.macro_period_ns};
  const rt::MonoTime epoch = rt::mono_time(prepared_.run().epoch_ns);
  if (mirror_) {
    mirror_->announce({rt::WallClock::now() + (epoch - rt::MonoClock::now()), basic, macro});
  } else if (simulated_) {
    simulated_->announce({rt::wall_time(rt::to_ns(epoch)), basic, macro});  // one clock for all boards
  }
}

void BoardMirror::notify() noexcept {
  if (mirror_) {
    mirror_->notify();
  } else if (simulated_) {
    simulated_->notify();
  }
}

const mirror::MirrorBlock* BoardMirror::block() const noexcept {
  return mirror_ ? &mirror_->block() : simulated_ ? &simulated_->block() : nullptr;
}

void BoardMirror::stop() noexcept {
  mirror_.reset();
  simulated_.reset();
}

}  // namespace indurop::node
