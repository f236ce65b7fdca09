// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/identify.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "control/robot/files/urdf.h"
#include "control/robot/kinematics/settings.h"
#include "core/base/read_file.h"

namespace indurop::robot {

namespace {

constexpr int kBody = 10;              // mass, mass times centre, six of the inertia about the arm's end
constexpr double kMoves = 0.01;        // rad/s or m/s; below this, the direction of dry friction is not known
constexpr std::size_t kFewest = 200;   // samples of an axis that moves
constexpr double kUsualInertia = 0.5;  // kg m^2, that a held body may have about the arm's end
constexpr double kUnknown = 1e4;       // kg, N m and so on: no number is known before
constexpr std::size_t kMostSamples = 6000;
constexpr std::size_t kMostDelay = 6;  // periods from a set point to its torque
constexpr double kNormal95 = 1.96;
constexpr double kWorstMass = 0.2;  // kg, or part of the mass, within which a result is worth something

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// A body whose Newton-Euler terms are one column: mass 1 in addition to `wanted` of the other numbers.
Body unit_body(int column) {
  const Vec3 place = column >= 1 && column <= 3 ? Vec3(Vec3::Unit(column - 1)) : Vec3(Vec3::Zero());
  // About the arm's end it has no inertia.
  Mat3 inertia = -(place.squaredNorm() * Mat3::Identity() - place * place.transpose());
  constexpr std::array<std::array<int, 2>, 6> kPlaces{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  if (column >= 4) {
    const auto [a, b] = kPlaces[static_cast<std::size_t>(column) - 4];
    inertia(a, b) = inertia(b, a) = 1;
  }
  return {1, place, inertia};
}

struct Motion {
  Joints q = Joints::Zero(), velocity = Joints::Zero(), acceleration = Joints::Zero();
};

Motion motion_of(const Arm& arm, const ArmSample& sample) {
  Motion motion;
  for (int i = 0; i < arm.count(); ++i) {
    const AxisSample& axis = sample[static_cast<std::size_t>(i)];
    const double unit = arm.axis(i).slides() ? 0.001 : kPi / 180;
    motion.q[i] = unit * axis.position;
    motion.velocity[i] = unit * axis.velocity;
    motion.acceleration[i] = unit * axis.acceleration;
  }
  return motion;
}

// Torques that are linear in what is sought: the held body, then dry friction and damping of each axis.
class Regression {
 public:
  Regression(const Arm& arm, const Dynamics& dynamics, std::span<const ArmSample> samples)
      : arm_(arm), samples_(samples), size_(kBody + 2 * arm.count()), rows_(static_cast<std::size_t>(arm.count())) {
    std::array<Dynamics, kBody> held;
    held.fill(dynamics);
    for (std::size_t k = 0; k < held.size(); ++k) {
      held[k].hold(unit_body(static_cast<int>(k)));
    }
    const std::size_t step = 1 + samples.size() / kMostSamples;
    for (Rows& rows : rows_) {
      rows.factors.resize(static_cast<Eigen::Index>(samples.size() / step + 1), size_);
    }
    for (std::size_t n = 0; n < samples.size(); n += step) {
      add(n, dynamics, held);
    }
  }

  // Solves with torques that come so many samples after their motion: with equal weights of the axes, then with those
  // that what remains unexplained gives. Returns how much that is, for comparison.
  double solve(std::size_t delay) {
    double rest = 0;
    for (Rows& rows : rows_) {
      rows.weight = 1;
      rows.take(samples_, delay);
    }
    for (int pass = 0; pass < 2; ++pass) {
      rest = solve();
    }
    return rest;
  }

  [[nodiscard]] Estimate number(int k) const { return {found_[k], kNormal95 * std::sqrt(inverse_(k, k))}; }
  // The centre of mass along one direction, in mm.
  [[nodiscard]] Estimate centre(int direction) const {
    const int k = 1 + direction;
    const double mass = found_[0];
    const double place = found_[k] / mass;
    const double square = inverse_(k, k) - 2 * place * inverse_(k, 0) + place * place * inverse_(0, 0);
    return {1000 * place, 1000 * kNormal95 * std::sqrt(std::max(0.0, square)) / std::abs(mass)};
  }
  [[nodiscard]] Identified::Axis axis(int i) const {
    const Rows& rows = rows_[static_cast<std::size_t>(i)];
    return {number(kBody + 2 * i), number(kBody + 2 * i + 1), std::sqrt(1 / rows.weight),
            static_cast<std::size_t>(rows.torques.size())};
  }

 private:
  // The samples in which one axis moves.
  struct Rows {
    std::size_t axis = 0;
    Matrix factors;
    std::vector<std::size_t> samples;
    std::vector<double> own;  // torques of the arm alone
    Vector torques;           // beyond those
    double weight = 1;

    void take(std::span<const ArmSample> all, std::size_t delay) {
      const auto last =
          std::find_if(samples.begin(), samples.end(), [&](std::size_t n) { return n + delay >= all.size(); });
      torques.resize(last - samples.begin());
      for (Eigen::Index r = 0; r < torques.size(); ++r) {
        const auto row = static_cast<std::size_t>(r);
        torques[r] = all[samples[row] + delay][axis].torque - own[row];
      }
    }
  };
  void add(std::size_t sample, const Dynamics& bare, const std::array<Dynamics, kBody>& held) {
    const Motion motion = motion_of(arm_, samples_[sample]);
    const Joints own = bare.torques(motion.q, motion.velocity, motion.acceleration);
    std::array<Joints, kBody> columns;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      columns[k] = held[k].torques(motion.q, motion.velocity, motion.acceleration) - own;
      columns[k] -= k > 0 ? columns[0] : Joints(Joints::Zero());
    }
    for (int i = 0; i < arm_.count(); ++i) {
      if (std::abs(motion.velocity[i]) < kMoves) {
        continue;
      }
      Rows& rows = rows_[static_cast<std::size_t>(i)];
      rows.axis = static_cast<std::size_t>(i);
      auto row = rows.factors.row(static_cast<Eigen::Index>(rows.samples.size()));
      row.setZero();
      for (int k = 0; k < kBody; ++k) {
        row[k] = columns[static_cast<std::size_t>(k)][i];
      }
      row[kBody + 2 * i] = std::copysign(1.0, motion.velocity[i]);
      row[kBody + 2 * i + 1] = motion.velocity[i];
      rows.samples.push_back(sample);
      rows.own.push_back(own[i]);
    }
  }

  double solve() {
    Matrix normal = Matrix::Zero(size_, size_);
    Vector right = Vector::Zero(size_);
    for (int k = 0; k < size_; ++k) {
      const double usual = k >= 4 && k < kBody ? kUsualInertia : kUnknown;
      normal(k, k) = 1 / (usual * usual);
    }
    for (const Rows& rows : rows_) {
      const auto factors = rows.factors.topRows(rows.torques.size());
      normal += rows.weight * factors.transpose() * factors;
      right += rows.weight * factors.transpose() * rows.torques;
    }
    inverse_ = normal.inverse();
    found_ = inverse_ * right;
    double all = 0;
    for (Rows& rows : rows_) {
      const auto count = rows.torques.size();
      const double square = (rows.torques - rows.factors.topRows(count) * found_).squaredNorm();
      rows.weight = 1 / std::max(1e-12, square / static_cast<double>(std::max<Eigen::Index>(1, count)));
      all -= std::log(rows.weight);
    }
    return all;
  }

  const Arm& arm_;
  std::span<const ArmSample> samples_;
  int size_;
  std::vector<Rows> rows_;
  Matrix inverse_;
  Vector found_;
};

std::string problem_of(const Arm& arm, std::span<const ArmSample> samples) {
  const auto axes = static_cast<std::size_t>(arm.count());
  if (samples.empty()) {
    return "the recording has no values of the axes; record AXIS_STATE while the arm moves";
  }
  if (std::any_of(samples.begin(), samples.end(), [&](const ArmSample& one) { return one.size() < axes; })) {
    return "the recording has " + std::to_string(samples.front().size()) + " axes, the arm " + std::to_string(axes) +
           "; is it the recording of another robot?";
  }
  const auto torque = [](const ArmSample& one) {
    return std::any_of(one.begin(), one.end(), [](const AxisSample& axis) { return axis.torque != 0; });
  };
  if (std::none_of(samples.begin(), samples.end(), torque)) {
    return "the recording has no torques; set the property rated_torque, and let the drives report theirs (6077h)";
  }
  return {};
}

}  // namespace

Identified identify(const std::string& urdf, const std::vector<double>& rotor_inertia,
                    std::span<const ArmSample> samples) {
  Identified result;
  const auto file = base::read_file(urdf);
  if (!file) {
    result.problem = base::cannot_read(urdf, file.error());
    return result;
  }
  const auto model = arm_from_urdf(urdf, *file);
  if (!model) {
    result.errors = model.error();
    return result;
  }
  if (!model->dynamics.known()) {
    result.problem = urdf + ": the links have no masses; give them <inertial>";
    return result;
  }
  if (result.problem = problem_of(model->arm, samples); !result.problem.empty()) {
    return result;
  }
  Dynamics dynamics = model->dynamics;
  dynamics.turn_rotors(of_axes(rotor_inertia));
  Regression regression(model->arm, dynamics, samples);
  // Drives report the torque of a set point some periods later.
  double least = HUGE_VAL;
  for (std::size_t delay = 0; delay <= kMostDelay && delay < samples.size(); ++delay) {
    if (const double rest = regression.solve(delay); rest < least) {
      least = rest;
      result.delay = delay;
    }
  }
  regression.solve(result.delay);
  for (int i = 0; i < model->arm.count(); ++i) {
    result.axes.push_back(regression.axis(i));
  }
  result.mass = regression.number(0);
  for (int k = 0; k < 3; ++k) {
    result.centre[static_cast<std::size_t>(k)] = regression.centre(k);
  }
  const bool moved = std::any_of(result.axes.begin(), result.axes.end(),
                                 [](const Identified::Axis& one) { return one.count >= kFewest; });
  if (!moved || !(result.mass.within < std::max(kWorstMass, kWorstMass * std::abs(result.mass.value)))) {
    std::ostringstream text;
    text << "the motion shows the mass only within " << std::setprecision(2) << result.mass.within
         << " kg; record a longer one that turns the last axes far, also up and down";
    result.problem = text.str();
  }
  return result;
}

}  // namespace indurop::robot
