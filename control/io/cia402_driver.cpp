// SPDX-License-Identifier: Apache-2.0
#include "control/io/cia402_driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "control/io/number.h"

namespace indurop::io {

namespace {

constexpr Number kMaxLoad = 1e6;  // N m

}  // namespace

Cia402Driver::Object Cia402Driver::object_of(const config::IoPoint& point) {
  constexpr std::array<std::pair<std::string_view, Object>, 18> kNames{{{"error", Object::Error},
                                                                        {"status", Object::Status},
                                                                        {"control", Object::Control},
                                                                        {"mode", Object::Mode},
                                                                        {"position", Object::Position},
                                                                        {"velocity", Object::Velocity},
                                                                        {"torque", Object::Torque},
                                                                        {"position_offset", Object::PositionOffset},
                                                                        {"velocity_offset", Object::VelocityOffset},
                                                                        {"torque_offset", Object::TorqueOffset},
                                                                        {"load", Object::Load},
                                                                        {"following", Object::Following},
                                                                        {"inputs", Object::Inputs},
                                                                        {"probe", Object::Probe},
                                                                        {"probe_rise", Object::ProbeRise},
                                                                        {"probe_fall", Object::ProbeFall},
                                                                        {"probe2_rise", Object::Probe2Rise},
                                                                        {"probe2_fall", Object::Probe2Fall}}};
  for (const auto& [name, object] : kNames) {
    if (name == point.at) {
      return object;
    }
  }
  return Object::Position;
}

Cia402Driver::Cia402Driver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
                           std::span<const config::IoPoint> inputs)
    : drive_(device.axis) {
  for (const config::IoPoint& point : outputs) {
    outputs_.push_back(object_of(point));
  }
  for (const config::IoPoint& point : inputs) {
    inputs_.push_back(object_of(point));
  }
}

void Cia402Driver::take(Object object, Sample& from) noexcept {
  const auto into = [&from](auto& value) {
    from.quality = to_whole(from.value, value) ? Quality::Good : Quality::OutOfRange;
  };
  switch (object) {
    case Object::Control:
      return into(command_.control);
    case Object::Mode:
      return into(command_.mode);
    case Object::Position:
      return into(command_.position);
    case Object::Velocity:
      return into(command_.velocity);
    case Object::Torque:
      return into(command_.torque);
    case Object::PositionOffset:
      return into(command_.position_offset);
    case Object::VelocityOffset:
      return into(command_.velocity_offset);
    case Object::TorqueOffset:
      return into(command_.torque_offset);
    case Object::Load:
      from.quality = std::fabs(from.value) <= kMaxLoad ? Quality::Good : Quality::OutOfRange;
      if (!std::isnan(from.value)) {
        command_.load = static_cast<double>(std::clamp(from.value, -kMaxLoad, kMaxLoad));
      }
      return;
    case Object::Probe:
      return into(command_.probe);
    case Object::Error:
    case Object::Status:
    case Object::Following:
    case Object::Inputs:
    case Object::ProbeRise:
    case Object::ProbeFall:
    case Object::Probe2Rise:
    case Object::Probe2Fall:
      return;
  }
}

Number Cia402Driver::value_of(Object object, const DriveFeedback& feedback) noexcept {
  switch (object) {
    case Object::Error:
      return feedback.error;
    case Object::Status:
      return feedback.status;
    case Object::Mode:
      return feedback.mode;
    case Object::Position:
      return feedback.position;
    case Object::Velocity:
      return feedback.velocity;
    case Object::Torque:
      return feedback.torque;
    case Object::Following:
      return feedback.following;
    case Object::Inputs:
      return feedback.inputs;
    case Object::Probe:
      return feedback.probe;
    case Object::ProbeRise:
      return feedback.probe_rise;
    case Object::ProbeFall:
      return feedback.probe_fall;
    case Object::Probe2Rise:
      return feedback.probe2_rise;
    case Object::Probe2Fall:
      return feedback.probe2_fall;
    case Object::Control:
    case Object::PositionOffset:
    case Object::VelocityOffset:
    case Object::TorqueOffset:
    case Object::Load:
      break;
  }
  return 0;
}

Driver::Outcome Cia402Driver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                       std::chrono::nanoseconds elapsed) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].quality == Quality::Good) {
      take(outputs_[i], outputs[i]);
    }
  }
  const DriveFeedback feedback = drive_.step(command_, elapsed);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i] = {value_of(inputs_[i], feedback), Quality::Good};
  }
  return Outcome::Good;
}

}  // namespace indurop::io
