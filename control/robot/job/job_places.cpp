// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/job_places.h"

#include <limits>

namespace indurop::robot {

void JobPlaces::reset() noexcept {
  for (Placed& one : placed_) {
    one.known = false;
  }
  found_.known = false;
}

void JobPlaces::set(int computed, const Pose& pose, const Quat& axes) noexcept {
  placed_[static_cast<std::size_t>(computed)] = {true, pose, axes};
}

const JobPlaces::Placed* JobPlaces::placed(int computed) const noexcept {
  const Placed* const one = computed < 0 ? nullptr : &placed_[static_cast<std::size_t>(computed)];
  return one != nullptr && one->known ? one : nullptr;
}

Pose JobPlaces::frame_pose(int frame) const noexcept {
  const WorkFrame& declared = book_.frames[static_cast<std::size_t>(frame)];
  const Placed* const moved = placed(declared.computed);
  return moved != nullptr ? moved->pose : declared.pose;
}

Target JobPlaces::target(int point, int tool) const noexcept {
  const Point& declared = book_.points[static_cast<std::size_t>(point)];
  Target target = book_.target(point, tool);
  if (const Placed* const moved = placed(declared.computed); moved != nullptr) {
    target.pose = moved->pose;
    target.known = nullptr;
  } else if (declared.frame >= 0 &&
             placed(book_.frames[static_cast<std::size_t>(declared.frame)].computed) != nullptr) {
    target.pose = frame_pose(declared.frame) * declared.in_frame;
    target.known = nullptr;
  }
  return target;
}

Quat JobPlaces::axes(int point) const noexcept {
  const Point& declared = book_.points[static_cast<std::size_t>(point)];
  if (const Placed* const moved = placed(declared.computed); moved != nullptr) {
    return moved->axes;
  }
  return declared.frame >= 0 ? frame_pose(declared.frame).orientation : declared.axes;
}

bool JobPlaces::pose_of(int first, FormulaInput& in, Pose& pose) const noexcept {
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = book_.formulas[static_cast<std::size_t>(first) + i].value(in);
    if (std::isnan(numbers[i])) {
      return false;
    }
  }
  pose.position = Vec3(numbers[0], numbers[1], numbers[2]) / 1000;
  pose.orientation = from_rpy({radians(numbers[3]), radians(numbers[4]), radians(numbers[5])});
  return true;
}

bool JobPlaces::leaf(const PlacePart& part, FormulaInput& in, Pose& pose) const noexcept {
  switch (part.op) {
    case PlaceOp::Pose:
      return pose_of(part.index, in, pose);
    case PlaceOp::Here:
      pose = in.port->tip_at(in.port->commanded());
      return true;
    case PlaceOp::World:
      pose = in.port->world_at(in.port->commanded());
      return true;
    case PlaceOp::Found:
      pose = found_.pose;
      in.flaw =
          found_.known ? in.flaw : "FOUND is where UNTIL ended a motion, and the last one ended nowhere; ask IF FOUND";
      return found_.known;
    default:
      break;
  }
  if (part.is_frame) {
    pose = frame_pose(part.index);
    return true;
  }
  const Target at = target(part.index, 0);
  pose = at.is_pose ? at.pose : in.port->tip_at(at.joints);
  return true;
}

bool JobPlaces::compute(int formula, FormulaInput& in, Pose& pose, Quat& axes) const noexcept {
  const PlaceFormula& asked = book_.places[static_cast<std::size_t>(formula)];
  std::array<Pose, PlaceFormula::kMaxPlaces + 1> stack{};
  std::size_t top = 0;
  axes = Quat::Identity();
  for (std::size_t i = 0; i < asked.count; ++i) {
    const PlacePart& part = book_.place_parts[asked.first + i];
    if (part.op == PlaceOp::Inverse) {
      stack[top - 1] = inverse_of(stack[top - 1]);
    } else if (part.op == PlaceOp::Joined) {
      --top;
      stack[top - 1] = stack[top - 1] * stack[top];
    } else if (part.op == PlaceOp::In) {
      --top;
      axes = stack[top].orientation;
      stack[top - 1] = stack[top] * stack[top - 1];
    } else if (!leaf(part, in, stack[top++])) {
      return false;
    }
  }
  pose = stack[0];
  if (!pose.position.allFinite()) {
    in.flaw = "this place has no value: a number in it is too large";
  }
  return pose.position.allFinite();
}

double JobPlaces::coordinate(int formula, Coordinate which, FormulaInput& in) const noexcept {
  Pose pose;
  Quat axes;
  if (!compute(formula, in, pose, axes)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (which == Coordinate::Distance) {
    return 1000 * pose.position.norm();
  }
  const auto i = static_cast<Eigen::Index>(which);
  return which <= Coordinate::Z ? 1000 * pose.position[i] : degrees(to_rpy(pose.orientation)[i - 3]);
}

}  // namespace indurop::robot
