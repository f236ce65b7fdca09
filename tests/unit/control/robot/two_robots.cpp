// SPDX-License-Identifier: Apache-2.0
#include "two_robots.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

Eigen::Isometry3d frame_of(const std::vector<double>& base) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(Vec3(base[0], base[1], base[2]) / 1000);
  const auto turn = [&](std::size_t i, const Vec3& axis) { return Eigen::AngleAxisd(base[i] * kPi / 180, axis); };
  frame.rotate(turn(5, Vec3::UnitZ()) * turn(4, Vec3::UnitY()) * turn(3, Vec3::UnitX()));
  return frame;
}

// With a positioner, the frame of poses is the workpiece's.
std::vector<double> base_of(const std::vector<double>& base, const ReferenceArm& arm) {
  const Eigen::Isometry3d there = frame_of(base) * arm.workpiece();
  const Vec3 place = 1000 * there.translation();
  const Vec3 rpy = to_rpy(Quat(there.rotation())) * (180 / kPi);
  return arm.table.empty() ? base : std::vector<double>{place[0], place[1], place[2], rpy[0], rpy[1], rpy[2]};
}

double radius(const ReferenceSolid& solid) {
  switch (solid.kind) {
    case ReferenceSolid::Kind::Box:
      return solid.size.norm() / 2;
    case ReferenceSolid::Kind::Cylinder:
      return std::hypot(solid.size[0], solid.size[1] / 2);
    case ReferenceSolid::Kind::Ball:
      break;
  }
  return solid.size[0];
}

}  // namespace

SharingRobots::SharingRobots(const std::vector<SharingRobot>& robots, double period_ms, bool shares,
                             std::vector<double> box)
    : box_(std::move(box)), reports_(robots.size()) {
  arms_.reserve(robots.size());
  for (const SharingRobot& robot : robots) {
    arms_.push_back(robot.table > 0 ? ReferenceArm::with_table(robot.table) : ReferenceArm::usual());
    Settings settings;
    settings.plan_in_tick = true;
    if (shares) {
      settings.name = robot.name;
      settings.cell_box = box_;
      settings.base_in_cell = base_of(robot.base, arms_.back());
      for (const SharingRobot& other : robots) {
        if (other.name != robot.name) {
          settings.other_robots.push_back(other.name);
        }
      }
    }
    cells_.push_back(std::make_unique<Cell>(robot.job, period_ms, 0, true, settings, arms_.back().urdf()));
    cells_.back()->in.drives[0].position = static_cast<std::int32_t>(robot.turned / 360 * 1'320'000);
    bases_.push_back(frame_of(robot.base));
  }
}

void SharingRobots::step() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::size_t k = 0;
    for (std::size_t other = 0; other < cells_.size() && cells_[i]->out.space != nullptr; ++other) {
      if (other != i) {
        cells_[i]->in.others[k++] = &reports_[other];
      }
    }
    cells_[i]->in.tick = tick_;
    cells_[i]->step();
    if (cells_[i]->out.space != nullptr) {
      reports_[i] = *cells_[i]->out.space;
    }
  }
  ++tick_;
}

bool SharingRobots::enable() {
  for (const auto& cell : cells_) {
    cell->ask(Service::GroupEnable);
  }
  return until([&] {
    return std::all_of(cells_.begin(), cells_.end(),
                       [](const auto& cell) { return cell->out.state == GroupState::Standby; });
  });
}

std::vector<ReferencePlace> SharingRobots::places(std::size_t i) const {
  Joints q = Joints::Zero();
  for (std::size_t k = 0; k < arms_[i].joints.size() + arms_[i].table.size(); ++k) {
    q[static_cast<Eigen::Index>(k)] = cells_[i]->out.command[k] * kPi / 180;
  }
  std::vector<ReferencePlace> places = arms_[i].places(q);
  for (ReferencePlace& place : places) {
    place.frame = bases_[i] * place.frame;
  }
  return places;
}

double SharingRobots::apart(std::size_t one, std::size_t other, double most) const {
  double least = most;
  const std::vector<ReferencePlace> others = places(other);
  for (const ReferencePlace& a : places(one)) {
    for (const ReferencePlace& b : others) {
      const double between = (a.frame.translation() - b.frame.translation()).norm();
      if (between - radius(*a.solid) - radius(*b.solid) < least) {
        least = std::min(least, reference_distance(a, b));
      }
    }
  }
  return least;
}

bool SharingRobots::holds_its_bodies(std::size_t i) const {
  const SpaceCells& held = reports_[i].held;
  constexpr std::array<int, 3> kCount{32, 32, 32};
  for (const ReferencePlace& place : places(i)) {
    // Points of the body: corners of a box around it, brought onto it.
    for (int n = 0; n < 27; ++n) {
      const Vec3 corner = Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1).cast<double>() * radius(*place.solid);
      const Vec3 point = 1000 * (place.frame * place.solid->nearest(corner));
      std::array<int, 3> cell{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double part = (point[static_cast<Eigen::Index>(k)] - box_[k]) / (box_[k + 3] - box_[k]);
        cell[k] = std::clamp(static_cast<int>(std::floor(part * kCount[k])), 0, kCount[k] - 1);
      }
      const auto word = static_cast<std::size_t>(cell[0] * 32 + cell[1]) / 2;
      const int bit = cell[1] % 2 * 32 + cell[2];
      if ((held[word] >> static_cast<unsigned>(bit) & 1U) == 0) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace indurop::robot
