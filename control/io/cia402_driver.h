// SPDX-License-Identifier: Apache-2.0
// The simulated drive as a device of I/O dispatch: points are named after its objects.

#pragma once

#include <vector>

#include "control/io/cia402_drive.h"
#include "control/io/driver.h"

namespace indurop::io {

class Cia402Driver final : public Driver {
 public:
  Cia402Driver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
               std::span<const config::IoPoint> inputs);

  [[nodiscard]] bool in_tick() const noexcept override { return true; }
  bool open() override { return true; }
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override {}
  [[nodiscard]] std::string problem() const override { return {}; }

 private:
  enum class Object {
    Error,
    Status,
    Control,
    Mode,
    Position,
    Velocity,
    Torque,
    PositionOffset,
    VelocityOffset,
    TorqueOffset,
    Load,
    Following,
    Inputs,
    Probe,
    ProbeRise,
    ProbeFall,
    Probe2Rise,
    Probe2Fall
  };
  static Object object_of(const config::IoPoint& point);
  void take(Object object, Sample& from) noexcept;
  static Number value_of(Object object, const DriveFeedback& feedback) noexcept;

  std::vector<Object> outputs_;
  std::vector<Object> inputs_;
  DriveCommand command_;
  Cia402Drive drive_;
};

}  // namespace indurop::io
