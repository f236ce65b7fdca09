// SPDX-License-Identifier: Apache-2.0
#include "node/parts/board_mirror.h"

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "network/mirror/frames/mirror.h"
#include "node/run/rights.h"
#include "node/simulate/simulated_mirror.h"
#include "scheduler/bands.h"

namespace indurop::node {

namespace {

class NetworkMirror final : public RunningMirror {
 public:
  explicit NetworkMirror(mirror::Mirror mirror) noexcept : mirror_(std::move(mirror)) {}

  void announce(rt::MonoTime epoch, std::chrono::nanoseconds basic, std::chrono::nanoseconds macro) noexcept override {
    mirror_.announce({rt::WallClock::now() + (epoch - rt::MonoClock::now()), basic, macro});
  }
  void notify() noexcept override { mirror_.notify(); }
  void follow(const mirror::Routes& routes) override { mirror_.follow(routes); }
  [[nodiscard]] const mirror::MirrorBlock& block() const noexcept override { return mirror_.block(); }

 private:
  mirror::Mirror mirror_;
};

}  // namespace

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
  running_ = std::make_unique<NetworkMirror>(std::move(started).value());
  return {};
}

Result<void, Ending> BoardMirror::start_simulated(Simulation& simulation) {
  auto started = SimulatedMirror::start(std::move(*checked_.mirror), options_.node, *simulation.place(),
                                        *prepared_.store, prepared_.run().tick, simulation.kernel());
  if (!started) {
    console_.error("cannot start the mirror to other boards: {}", describe(started.error()));
    return Ending{kFailed};
  }
  SimulatedMirror* const simulated = started->get();
  running_ = std::move(started).value();
  simulation.connect({[simulated](const mirror::Message& message) { simulated->arrived(message); },
                      [simulated] { return simulated->take_sent(); }});
  return {};
}

void BoardMirror::announce() noexcept {
  const std::uint64_t number = prepared_.run().schedule.load();
  if (running_ && std::exchange(announced_, number) != number) {
    running_->announce(rt::mono_time(prepared_.run().epoch_ns),
                       std::chrono::nanoseconds{prepared_.setup.basic_period_ns},
                       std::chrono::nanoseconds{prepared_.run().macro_period_ns.load()});
  }
}

void BoardMirror::notify() noexcept {
  if (running_) {
    running_->notify();
  }
}

void BoardMirror::follow(const mirror::Routes& routes) {
  if (running_) {
    running_->follow(routes);
  }
}

const mirror::MirrorBlock* BoardMirror::block() const noexcept {
  return running_ ? &running_->block() : nullptr;
}

void BoardMirror::stop() noexcept {
  running_.reset();
}

}  // namespace indurop::node
