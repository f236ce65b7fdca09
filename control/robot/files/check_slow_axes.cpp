// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/check_slow_axes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "control/robot/plan/path_geometry.h"

namespace indurop::robot {

namespace {

template <std::size_t N>
bool is_one_of(const Op (&ops)[N], Op op) noexcept {
  return std::find(std::begin(ops), std::end(ops), op) != std::end(ops);
}

// They neither move the robot nor exchange its tool.
constexpr Op kStays[] = {Op::Zone,      Op::Acceleration, Op::Load,    Op::Weave,  Op::Correct,
                         Op::Set,       Op::SetOnPath,    Op::Follow,  Op::Assign, Op::WaitTime,
                         Op::WaitUntil, Op::Ask,          Op::Message, Op::Arm,    Op::Disarm};
// Step::index of them is another step that may come next.
constexpr Op kJumps[] = {Op::WaitUntil, Op::Ask, Op::Try, Op::Goto, Op::If, Op::Unless, Op::Again, Op::Loop, Op::End};

// Goes through the steps of a job with what is known of the robot there.
class Walk {
 public:
  Walk(const JobBook& book, const Job& job, const ArmModel& model, double tool_speed,
       std::vector<base::Diagnostic>& warnings)
      : book_(book),
        job_(job),
        model_(model),
        fastest_(tool_speed > 0 ? tool_speed / 1000 : HUGE_VAL),
        warnings_(warnings) {}

  void go() {
    std::vector<bool> entered(job_.steps.size() + 1);  // by a jump
    for (const Step& step : job_.steps) {
      if (is_one_of(kJumps, step.op) && step.index >= 0) {
        entered[static_cast<std::size_t>(step.index)] = true;
      }
    }
    for (std::size_t i = 0; i < job_.steps.size(); ++i) {
      now_ = entered[i] ? Known{} : now_;
      take(job_.steps[i]);
    }
  }

 private:
  struct Known {
    std::optional<Vec3> tip{};
    std::array<std::optional<double>, kAxes> axes{};
    std::optional<double> speed{};  // m/s, if SPEED says it in mm/s
  };

  [[nodiscard]] static std::optional<double> constant(const Step& setting) {
    return setting.formula < 0 ? std::optional(setting.value) : std::nullopt;
  }
  [[nodiscard]] static std::optional<double> speed_of(const Step& setting) {
    return setting.index == 1 ? constant(setting) : std::nullopt;
  }
  [[nodiscard]] const Point* point(int index) const {
    const Point* const found = index >= 0 ? &book_.points[static_cast<std::size_t>(index)] : nullptr;
    return found != nullptr && !book_.is_computed(*found) ? found : nullptr;
  }
  [[nodiscard]] std::optional<Vec3> tip_at(int index) const {
    const Point* const there = point(index);
    return there != nullptr && there->target.is_pose ? std::optional(there->target.pose.position) : std::nullopt;
  }

  void take(const Step& step) {
    if (step.op == Op::Speed) {
      now_.speed = speed_of(step);
    } else if (step.op == Op::Move) {
      move(step);
    } else if (!is_one_of(kStays, step.op)) {
      now_ = {};
    }
  }

  void move(const Step& step) {
    Known end = now_;
    const bool stays = step.move == Move::Line && step.index == kHere;
    end.tip = step.formula >= 0 ? std::nullopt : stays ? now_.tip : tip_at(step.index);
    const Point* const there = point(step.index);
    for (int i = 0; i < model_.arm.count(); ++i) {
      std::optional<double>& axis = end.axes[static_cast<std::size_t>(i)];
      if (step.index != kHere && there == nullptr) {
        axis.reset();
      } else if (there != nullptr && (!there->target.is_pose || holds(there->target.held, i))) {
        axis = there->target.joints[i];
      }
    }
    std::optional<double> speed = now_.speed;
    if (const MotionExtras* const extras = book_.extras_of(step); extras != nullptr) {
      for (const Step& setting : extras->settings) {
        speed = setting.op == Op::Speed ? speed_of(setting) : speed;
        if (setting.op == Op::Axis) {
          end.axes[static_cast<std::size_t>(setting.index)] = constant(setting);
        }
      }
    }
    if (speed && (step.move == Move::Line || step.move == Move::Circle)) {
      compare(step, end, std::min(*speed, fastest_));
    }
    now_ = end;
  }

  // Returns the length of a line or a circle, in m.
  [[nodiscard]] std::optional<double> way(const Step& step, const Known& end) const {
    if (!now_.tip || !end.tip) {
      return std::nullopt;
    }
    if (step.move == Move::Line) {
      return (*end.tip - *now_.tip).norm();
    }
    const std::optional<Vec3> mid = tip_at(step.mid);
    return mid ? std::optional(arc_way(*now_.tip, *mid, *end.tip)) : std::nullopt;
  }

  void compare(const Step& step, const Known& end, double speed) {
    constexpr double kLeastWay = 1e-6;  // m; a tool that keeps its place has another speed
    constexpr double kSlower = 1.001;
    const std::optional<double> length = way(step, end);
    const Held free = redundant_axes(model_.arm);
    double seconds = length.value_or(0) < kLeastWay ? HUGE_VAL : kSlower * *length / speed;
    int slowest = -1;
    for (int i = 0; i < model_.arm.count(); ++i) {
      const auto& from = now_.axes[static_cast<std::size_t>(i)];
      const auto& to = end.axes[static_cast<std::size_t>(i)];
      const double takes = holds(free, i) && from && to ? std::abs(*to - *from) / model_.velocity[i] : 0;
      slowest = takes > seconds ? i : slowest;
      seconds = std::max(seconds, takes);
    }
    if (slowest >= 0) {
      const auto axis = static_cast<std::size_t>(slowest);
      warn(step, speed, slowest, std::abs(*end.axes[axis] - *now_.axes[axis]), *length / seconds);
    }
  }

  void warn(const Step& step, double speed, int index, double moved, double possible) {
    const Axis& axis = model_.arm.axis(index);
    const double unit = axis.slides() ? 0.001 : kPi / 180;
    const std::string name = axis.slides() ? "mm" : "degrees";
    std::ostringstream text;
    text.precision(4);
    text << "SPEED " << 1000 * speed << " mm/s is too fast for axis " << index + 1 << " (" << axis.name << "): its "
         << moved / unit << " " << name << " take " << moved / model_.velocity[index] << " s at full speed, "
         << model_.velocity[index] / unit << " " << name << "/s, so the tool moves at " << 1000 * possible
         << " mm/s at most";
    warnings_.push_back({base::Diagnostic::Severity::Warning, job_.file, {static_cast<int>(step.line), 1}, text.str()});
  }

  const JobBook& book_;
  const Job& job_;
  const ArmModel& model_;
  double fastest_;  // m/s
  std::vector<base::Diagnostic>& warnings_;
  Known now_;
};

}  // namespace

std::vector<base::Diagnostic> check_slow_axes(const JobBook& book, const ArmModel& model, double tool_speed) {
  std::vector<base::Diagnostic> warnings;
  for (const Job& job : book.jobs) {
    Walk(book, job, model, tool_speed, warnings).go();
  }
  return warnings;
}

}  // namespace indurop::robot
