// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

// The weight at distance `u`, from -1 to 1, its derivative, its integral from -1 on and the integral of that.
double weight(double u) noexcept {
  const double rest = 1 - u * u;
  return 15.0 / 16 * rest * rest;
}

double weight_change(double u) noexcept {
  return -15.0 / 4 * u * (1 - u * u);
}

double sum(double u) noexcept {
  return 0.5 + 15.0 / 16 * u * (1 - u * u * (2.0 / 3 - u * u / 5));
}

double sum_of_sums(double u) noexcept {
  const double square = u * u;
  return 5.0 / 32 + u / 2 + 15.0 / 32 * square * (1 - square * (1.0 / 3 - square / 15));
}

constexpr int kLinesWithin = 24;        // lines in reach of a place to either side
constexpr double kLongestChain = 10;    // s at full speed
constexpr double kSharp = 0.2;          // change of direction of a corner that needs knots of its own
constexpr double kMostSharpTurns = 25;  // sum of the changes of direction in such corners

}  // namespace

void Chain::begin(const Pose& start, const ToolLimits& tool) noexcept {
  tool_ = tool;
  count_ = 0;
  crowded_ = false;
  arc_count_ = 0;
  way_ = at_speed_ = turned_ = at_[0] = 0;
  poses_[0] = start;
}

bool Chain::takes(const Line& line) const noexcept {
  Arc arc;
  return !line.bent || (arc_count_ < kMaxArcs && arc.through(poses_[at(count_)].position, line.mid, line.end.position));
}

bool Chain::add(const Line& line) noexcept {
  const std::size_t i = at(count_);
  const Pose& from = poses_[i];
  const Vec3 turn = rotation_between(from.orientation, line.end.orientation);
  Arc arc;
  const bool bent = line.bent && arc.through(from.position, line.mid, line.end.position);
  const double way = bent ? arc.way() : (line.end.position - from.position).norm();
  const double length = std::max(way / tool_.velocity, turn.norm() / tool_.turn_velocity);
  if (length <= 1e-9) {
    return false;
  }
  arc_of_[i] = 0;
  if (bent) {
    arcs_[at(arc_count_)] = arc;
    arc_of_[i] = static_cast<std::uint8_t>(++arc_count_);
  }
  poses_[i + 1] = line.end;
  at_[i + 1] = at_[i] + length;
  moving_[i] = bent ? Vec3(arc.derivative(0, 1) / length) : Vec3((line.end.position - from.position) / length);
  turning_[i] = from.orientation * turn / length;
  turns_[i] = turn;
  speeds_[i] = line.tool_speed > 0 ? std::min(1.0, shared(line.tool_speed, way / length)) : line.speed;
  sources_[i] = line.source;
  zones_[i] = line.zone;
  if (count_ > 0) {
    crowded_ = crowded_ || way < zones_[i - 1] + line.zone;
    const double turned = (moving_[i] - slope(count_ - 1, length_of(count_ - 1), 1)).norm() / tool_.velocity;
    turned_ += turned > kSharp ? turned : 0;
  }
  way_ += way;
  at_speed_ += length / speeds_[i];
  ++count_;
  return true;
}

Vec3 Chain::on_line(int i, double progress) const noexcept {
  const int arc = arc_of_[at(i)];
  return arc > 0 ? arcs_[at(arc - 1)].at(progress / length_of(i))
                 : Vec3(poses_[at(i)].position + progress * moving_[at(i)]);
}

Vec3 Chain::slope(int i, double progress, int order) const noexcept {
  if (const int arc = arc_of_[at(i)]; arc > 0) {
    const double length = length_of(i);
    return arcs_[at(arc - 1)].derivative(progress / length, order) / std::pow(length, order);
  }
  return order == 1 ? moving_[at(i)] : Vec3(Vec3::Zero());
}

bool Chain::full() const noexcept {
  return count_ == kMaxLines || length() >= kLongestChain || turned_ > kMostSharpTurns;
}

MoveCommand Chain::line(int i) const noexcept {
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = poses_[at(i + 1)];
  if (arc_of_[at(i)] > 0) {
    command.move = Move::Circle;
    command.mid.is_pose = true;
    command.mid.pose.position = on_line(i, length_of(i) / 2);
  }
  command.speed = speeds_[at(i)];
  command.source = sources_[at(i)];
  return command;
}

double Chain::least_time(int i) const noexcept {
  const double pace = moving_[at(i)].norm();
  const double turning = turning_[at(i)].norm();
  const LineLimits most{speeds_[at(i)],
                        std::min(shared(tool_.acceleration, pace), shared(tool_.turn_acceleration, turning)),
                        std::min(shared(tool_.jerk, pace), shared(tool_.turn_jerk, turning))};
  return Profile::to_position({}, length_of(i), 0, most).duration();
}

// How far the mean around corner `i` reaches: as far as the zone. In curves made of chords that are not much longer
// than that, it reaches over all of the shorter one, so that they become smooth; it deviates no farther from the corner
// than a right angle with that zone.
double Chain::reach(int i) const noexcept {
  constexpr double kOfLine = 0.3;
  constexpr double kRightAngle = std::numbers::sqrt2;  // change of direction
  const auto zone = [this](int k) {
    return shared(zones_[at(k - 1)], std::max(slope(k - 1, length_of(k - 1), 1).norm(), moving_[at(k)].norm()));
  };
  const auto shorter = [this](int k) { return std::min(length_of(k - 1), length_of(k)); };
  const auto is_of_curve = [&](int k) {
    if (k <= 0 || k >= count_) {
      return false;
    }
    const Vec3 before = slope(k - 1, length_of(k - 1), 1);
    const double fastest = std::max(before.norm(), moving_[at(k)].norm());
    return zone(k) >= kOfLine * shorter(k) &&
           (moving_[at(k)] - before).norm() * shorter(k) <= kRightAngle * fastest * zone(k);
  };
  double reach = zone(i);
  if (is_of_curve(i) && (is_of_curve(i - 1) || is_of_curve(i + 1))) {
    reach = std::max(reach, shorter(i));
  }
  if (i > kLinesWithin) {
    reach = std::min(reach, at_[at(i)] - at_[at(i - kLinesWithin)]);
  }
  if (i + kLinesWithin < count_) {
    reach = std::min(reach, at_[at(i + kLinesWithin)] - at_[at(i)]);
  }
  return reach;
}

// From corner to corner a mean becomes wider or narrower by the length of the line at most: then means begin and end
// one after the other, none of them goes back, and the path begins and ends where the lines do.
void Chain::finish() noexcept {
  half_[0] = half_[at(count_)] = 0;
  for (int i = 1; i < count_; ++i) {
    half_[at(i)] = std::min(reach(i), half_[at(i - 1)] + length_of(i - 1));
  }
  for (int i = count_ - 1; i > 0; --i) {
    half_[at(i)] = std::min(half_[at(i)], half_[at(i + 1)] + length_of(i));
  }
}

Chain::Window Chain::window(double place) const noexcept {
  // The number of corners, one after the other, for which it is true.
  const auto many = [this](const auto& passed) {
    int low = 0;
    for (int high = count_ - 1; low < high;) {
      const int middle = (low + high + 1) / 2;
      if (passed(middle)) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    return low;
  };
  const int ended = many([&](int i) { return at_[at(i)] + half_[at(i)] <= place; });
  const int begun = many([&](int i) { return at_[at(i)] - half_[at(i)] < place; });
  return {ended, std::max(ended, begun)};
}

Chain::Progress Chain::beyond(int i, double place) const noexcept {
  const double from = place - at_[at(i)];
  const double half = half_[at(i)];
  if (std::abs(from) >= half) {
    return from > 0 ? Progress{from, 1, 0, 0} : Progress{};
  }
  const double u = from / half;
  return {half * sum_of_sums(u), sum(u), weight(u) / half, weight_change(u) / (half * half)};
}

// Each line goes on while its part in the mean lasts, before its end already more and more slowly: there the next one
// begins.
Pose Chain::pose_at(double place) const noexcept {
  place = std::clamp(place, 0.0, length());
  const Window w = window(place);
  Pose pose = poses_[at(w.first)];
  double before = place - at_[at(w.first)];
  for (int i = w.first; i <= w.last; ++i) {
    const double behind = beyond(i + 1, place).value;
    const double progress = before - behind;
    pose.position += on_line(i, progress) - poses_[at(i)].position;
    pose.orientation = pose.orientation * rotation_by(std::clamp(progress / length_of(i), 0.0, 1.0) * turns_[at(i)]);
    before = behind;
  }
  return pose;
}

// In a bend the mean of velocities is shorter than they are: there the speed of the place rises, so that the tool keeps
// the speed of the command.
Chain::Shape Chain::shape_at(double place) const noexcept {
  constexpr double kMostFaster = 10;  // where the tool nearly turns back
  place = std::clamp(place, 0.0, length());
  const Window w = window(place);
  Shape shape;
  shape.speed = speeds_[at(w.first)];
  double pace = 0;
  double turn_pace = 0;
  Progress before{place - at_[at(w.first)], 1, 0, 0};
  for (int i = w.first; i <= w.last; ++i) {
    const Progress behind = beyond(i + 1, place);
    const double first = before.first - behind.first;
    const double second = before.second - behind.second;
    const double third = before.third - behind.third;
    const double progress = before.value - behind.value;
    const Vec3 speed = slope(i, progress, 1);
    const Vec3 bend = slope(i, progress, 2);
    shape.speed = std::min(shape.speed, speeds_[at(i)]);
    shape.moving += first * speed;
    shape.bend += second * speed + first * first * bend;
    shape.twist += third * speed + 3 * first * second * bend + first * first * first * slope(i, progress, 3);
    shape.turning += first * turning_[at(i)];
    shape.turn_bend += second * turning_[at(i)];
    shape.turn_twist += third * turning_[at(i)];
    pace += first * speed.norm();
    turn_pace += first * turning_[at(i)].norm();
    before = behind;
  }
  const double faster = std::min(shared(pace, shape.moving.norm()), shared(turn_pace, shape.turning.norm()));
  shape.speed *= std::clamp(faster, 1.0, kMostFaster);
  return shape;
}

int Chain::source_at(double place) const noexcept {
  const auto next = static_cast<int>(std::upper_bound(at_.data(), at_.data() + count_, place) - at_.data());
  return sources_[at(std::clamp(next - 1, 0, count_ - 1))];
}

}  // namespace indurop::robot
