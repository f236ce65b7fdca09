// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/path_outputs.h"

#include <algorithm>

namespace indurop::robot {

bool PathOutputs::add(const PathOutput& output) noexcept {
  auto* const free = std::find_if(all_.begin(), all_.end(), [](const Trigger& each) { return !each.waits; });
  if (free == all_.end()) {
    return false;
  }
  *free = {true, output};
  return true;
}

bool PathOutputs::is_full() const noexcept {
  return std::all_of(all_.begin(), all_.end(), [](const Trigger& each) { return each.waits; });
}

bool PathOutputs::any() const noexcept {
  return std::any_of(all_.begin(), all_.end(), [](const Trigger& each) { return each.waits; });
}

void PathOutputs::clear() noexcept {
  all_ = {};
}

void PathOutputs::discard_from(std::uint32_t ticket) noexcept {
  for (Trigger& each : all_) {
    each.waits = each.waits && each.output.ticket < ticket;
  }
}

bool PathOutputs::is_due(const PathOutput& output, const PathPlace& now, bool settled) const noexcept {
  if (settled || output.ticket < present_ || (now.ticket == 0 && output.ticket <= present_)) {
    return true;
  }
  if (output.ticket != now.ticket) {
    return false;
  }
  if (output.by_time) {
    return output.after ? since_ >= output.amount : now.to_go <= output.amount;
  }
  return output.after ? now.gone >= output.amount : now.left <= output.amount;
}

void PathOutputs::step(double seconds, const PathPlace& now, bool settled, Signals& signals, Pulses& pulses) noexcept {
  since_ = now.ticket == present_ ? since_ + seconds : 0;
  present_ = now.ticket > 0 ? now.ticket : present_;
  for (Trigger& each : all_) {
    if (!each.waits || !is_due(each.output, now, settled)) {
      continue;
    }
    const auto signal = static_cast<std::size_t>(each.output.signal);
    if (each.output.pulse > 0) {
      each.waits = !pulses.start(signal, each.output.pulse, signals);
      continue;
    }
    each.waits = false;
    pulses.forget(signal);
    signals.write(signal, each.output.value);
  }
}

}  // namespace indurop::robot
