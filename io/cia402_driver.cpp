// SPDX-License-Identifier: Apache-2.0
#include "io/cia402_driver.h"

#include <array>
#include <string_view>
#include <utility>

#include "io/number.h"

namespace indurop::io {

Cia402Driver::Object Cia402Driver::object_of(const config::IoPoint& point) {
  constexpr std::array<std::pair<std::string_view, Object>, 7> kNames{{{"error", Object::Error},
                                                                       {"status", Object::Status},
                                                                       {"control", Object::Control},
                                                                       {"mode", Object::Mode},
                                                                       {"position", Object::Position},
                                                                       {"velocity", Object::Velocity},
                                                                       {"torque", Object::Torque}}};
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

Driver::Outcome Cia402Driver::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                       std::chrono::nanoseconds elapsed) {
  const auto take = [](Sample& from, auto& into) {
    from.quality = to_whole(from.value, into) ? Quality::Good : Quality::OutOfRange;
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].quality != Quality::Good) {
      continue;
    }
    switch (outputs_[i]) {
      case Object::Control:
        take(outputs[i], command_.control);
        break;
      case Object::Mode:
        take(outputs[i], command_.mode);
        break;
      case Object::Position:
        take(outputs[i], command_.position);
        break;
      case Object::Velocity:
        take(outputs[i], command_.velocity);
        break;
      case Object::Error:
      case Object::Status:
      case Object::Torque:
        break;
    }
  }
  const DriveFeedback feedback = drive_.step(command_, elapsed);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i].quality = Quality::Good;
    switch (inputs_[i]) {
      case Object::Error:
        inputs[i].value = feedback.error;
        break;
      case Object::Status:
        inputs[i].value = feedback.status;
        break;
      case Object::Mode:
        inputs[i].value = feedback.mode;
        break;
      case Object::Position:
        inputs[i].value = feedback.position;
        break;
      case Object::Velocity:
        inputs[i].value = feedback.velocity;
        break;
      case Object::Torque:
        inputs[i].value = feedback.torque;
        break;
      case Object::Control:
        break;
    }
  }
  return Outcome::Good;
}

}  // namespace indurop::io
