// SPDX-License-Identifier: Apache-2.0
// A group of six axes with drives that follow commands at once.

#pragma once

#include <gtest/gtest.h>
#include <indurop/robot/controller.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "robot_fixture.h"

namespace indurop::robot {

// With drives that follow commands at once. An arm of another URDF has only the points of its job.
class Cell final : public Signals {
 public:
  explicit Cell(const std::string& job = "", double period_ms = 10, std::uint32_t asked_before = 0, bool heard = true,
                Settings settings = {}, const std::string& urdf = "", const JobTexts& others = {}) {
    settings.period = std::chrono::nanoseconds(static_cast<std::int64_t>(period_ms * 1e6));
    const std::string points =
        "POINT P1 = JOINT 20 10 -20 0 60 0\nPOINT P2 = POSE 500 100 400 RPY 180 0 180\n"
        "POINT P3 = POSE 3000 0 400 RPY 180 0 180\n";
    make_ = [=] {
      return urdf.empty() ? controller_of(cell_urdf(), points + job, settings, others)
                          : controller_of(urdf, job, settings, others);
    };
    sut = make_();
    for (DriveIn& drive : in.drives) {
      drive.status = kSwitchOnDisabled;
    }
    in.service.code = static_cast<std::int32_t>(Service::GroupEnable);
    in.service.number = asked_before;
    in.requests_known = heard;
    step();
  }

  double read(std::size_t index) noexcept override { return values[index]; }
  void write(std::size_t index, double value) noexcept override { values[index] = value; }

  // Another controller of the same files continues with what this one keeps. Returns false if it cannot be taken now.
  [[nodiscard]] bool exchange() {
    kept_.resize(Controller::kMostKept);
    const std::size_t bytes = sut->save(kept_.data(), kept_.size());
    other_ = other_ == nullptr ? make_() : std::move(other_);
    const bool good = bytes > 0 && other_->restore(kept_.data(), bytes);
    if (good) {
      std::swap(sut, other_);
      most_kept = std::max(most_kept, bytes);
    }
    return good;
  }

  void step() {
    // Any test can show that controllers are as good as one: INDUROP_ROBOT_EXCHANGE says after how many periods.
    static const char* const kEach = std::getenv("INDUROP_ROBOT_EXCHANGE");
    if (kEach != nullptr && periods % std::max(1, std::atoi(kEach)) == 0) {
      static_cast<void>(exchange());
    }
    sut->step(in, *this, out);
    ++periods;
    for (std::size_t i = 0; i < kJoints; ++i) {
      if (!stuck) {
        obey(in.drives[i], out.drives[i]);
      }
    }
  }
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition, int most = 5000) {
    for (int i = 0; i < most; ++i) {
      if (condition()) {
        return true;
      }
      step();
    }
    return false;
  }
  void ask(Service service) {
    in.service.code = static_cast<std::int32_t>(service);
    in.service.number = out.acknowledged + 1;
  }
  // True if it ends well.
  [[nodiscard]] bool serve(Service service) {
    ask(service);
    return until([&] { return out.done == in.service.number; }) && out.error == ErrorCode::Ok;
  }
  void ask_axis(std::size_t i, AxisService service, double position = 0, double velocity = 0) {
    in.axes[i] = {out.axes[i].acknowledged + 1, static_cast<std::int32_t>(service), position, velocity, 0, 0};
  }
  [[nodiscard]] bool serve_axis(std::size_t i, AxisService service, double position = 0, double velocity = 0) {
    ask_axis(i, service, position, velocity);
    return until([&] { return out.axes[i].done == in.axes[i].number || out.axes[i].aborted == in.axes[i].number; }) &&
           out.axes[i].done == in.axes[i].number;
  }

  static constexpr std::uint16_t kSwitchOnDisabled = 0x40;
  static constexpr std::uint16_t kFault = 0x08;
  std::unique_ptr<Controller> sut;
  Inputs in;
  Outputs out;
  double values[8] = {};
  bool stuck = false;
  int periods = 0;
  std::size_t most_kept = 0;  // bytes

 private:
  std::function<std::unique_ptr<Controller>()> make_;
  std::unique_ptr<Controller> other_;
  std::vector<std::byte> kept_;

  static void obey(DriveIn& in, const DriveOut& out) {
    in.mode = out.mode;
    if (in.status == kFault) {
      in.status = out.control == 0x80 ? kSwitchOnDisabled : kFault;
      return;
    }
    switch (out.control & 0x0FU) {
      case 0x06:
        in.status = 0x21;
        break;
      case 0x07:
        in.status = 0x23;
        break;
      case 0x0F:
        in.status = in.status == 0x21 ? 0x23 : 0x27;
        break;
      default:
        in.status = kSwitchOnDisabled;
    }
    if ((in.status & 0x6FU) == 0x27 && out.mode == 8) {
      in.position = out.position;
    }
    if (out.mode == 6 && (out.control & 0x10U) != 0) {
      in.position = 0;
      in.status = 0x27 | 1U << 12 | 1U << 10;
    }
  }
};

}  // namespace indurop::robot
