// SPDX-License-Identifier: Apache-2.0
#include "control/io/axis_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace indurop::io {
namespace {

constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15ULL;  // makes any seed usable

}  // namespace

AxisModel::AxisModel(const config::IoAxis& axis) noexcept
    : inertia_(axis.inertia),
      damping_(axis.damping),
      max_torque_(axis.torque),
      max_velocity_(axis.speed * kRadiansPerDegree),
      torque_rate_(2 * std::numbers::pi * axis.torque_bandwidth),
      // The two loops together are critically damped at the bandwidth: s^2 + 2 w s + w^2.
      position_gain_(std::numbers::pi * axis.bandwidth),
      velocity_gain_(4 * std::numbers::pi * axis.bandwidth),
      counts_per_radian_(axis.counts / (2 * std::numbers::pi)),
      noise_counts_(axis.noise),
      random_((axis.seed + 1) * kSpread),
      position_(axis.start * kRadiansPerDegree) {
  set_step(kStep);
}

void AxisModel::set_step(double step) noexcept {
  step_ = step;
  lag_ = torque_rate_ > 0 ? std::exp(-torque_rate_ * step) : 0;
}

void AxisModel::accelerate(double torque) noexcept {
  const double demanded = std::clamp(torque, -max_torque_, max_torque_);
  limited_ = limited_ || demanded != torque;
  torque_ = demanded + (torque_ - demanded) * lag_;
  move(torque_);
  torques_ += torque_;
}

void AxisModel::move(double torque) noexcept {
  velocity_ += (torque - load_ - damping_ * velocity_) / inertia_ * step_;
  position_ += velocity_ * step_;
  ++steps_;
}

double AxisModel::take_mean_torque() noexcept {
  const double sum = std::exchange(torques_, 0);
  const int steps = std::exchange(steps_, 0);
  return steps > 0 ? sum / steps : torque_;
}

void AxisModel::drive(const AxisReference& reference) noexcept {
  const double correction = reference.follow_position ? position_gain_ * (reference.position - position_) : 0;
  const double wanted = reference.velocity + correction;
  const double velocity = std::clamp(wanted, -max_velocity_, max_velocity_);
  limited_ = velocity != wanted;
  accelerate(inertia_ * velocity_gain_ * (velocity - velocity_) + damping_ * velocity + reference.torque);
}

void AxisModel::push(double torque) noexcept {
  const auto towards = [this](double velocity) {
    return inertia_ * velocity_gain_ * (velocity - velocity_) + damping_ * velocity;
  };
  const double allowed = std::clamp(torque, towards(-max_velocity_), towards(max_velocity_));
  limited_ = allowed != torque;
  accelerate(allowed);
}

void AxisModel::brake() noexcept {
  limited_ = false;
  // At most the torque that just stops the axis within the step.
  const double stopping = damping_ * velocity_ - velocity_ * inertia_ / step_;
  const double load = std::exchange(load_, 0);
  move(std::clamp(stopping, -max_torque_, max_torque_));
  load_ = load;
  torque_ = 0;  // the motor gives none
}

double AxisModel::noise() noexcept {
  // The sum of twelve numbers from 0 to 1 has standard deviation 1 and is nearly normal.
  constexpr int kTerms = 12;
  constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
  double sum = -kTerms / 2.0;
  for (int i = 0; i < kTerms; ++i) {
    random_ ^= random_ << 13U;
    random_ ^= random_ >> 7U;
    random_ ^= random_ << 17U;
    sum += static_cast<double>(random_ >> 11U) * kUnit;
  }
  return sum;
}

std::int64_t AxisModel::read_encoder() noexcept {
  const double exact = position_ * counts_per_radian_ + (noise_counts_ > 0 ? noise_counts_ * noise() : 0);
  return std::llround(std::floor(exact + 0.5));
}

}  // namespace indurop::io
