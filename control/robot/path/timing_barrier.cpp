// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/timing_barrier.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kMostSteps = 60;
constexpr double kEnough = 1e-3;  // of the duration: what the barrier may still cost
// Places that are derived in the time of checking one place including its inverse kinematics.
constexpr int kDerivedPerLook = 8;
constexpr int kWeighedPerLook = 16;

// The first row of vector `v`.
constexpr std::size_t row_of(int v) noexcept {
  return at(TimingPlace::kRows + 3 * v);
}

}  // namespace

// Starts at a constant speed that keeps all limits.
void TimingBarrier::begin(int count, int per_knot, int vectors) noexcept {
  count_ = count;
  per_knot_ = per_knot;
  vectors_ = vectors;
  double most = 1e12;
  for (int i = 0; i <= last(); ++i) {
    const TimingPlace& k = places_[at(i)];
    most = std::min(most, k.fastest);
    const auto keep = [&most](double bend, double third) {
      most = std::min({most, 1 / std::max(bend, 1e-12), std::pow(std::max(third, 1e-12), -2.0 / 3)});
    };
    for (std::size_t r = 0; r < kRows; ++r) {
      keep(std::abs(k.bend[r]), std::abs(k.third[r]));
    }
    for (int v = 0; v < vectors_; ++v) {
      keep(Eigen::Map<const Vec3>(&k.bend[row_of(v)]).norm(), Eigen::Map<const Vec3>(&k.third[row_of(v)]).norm());
    }
  }
  std::fill_n(z_.begin(), count_ + 3, 0.7 * most);
  stiff_ = 100 / std::pow(0.7 * most, 2.5);
  weight_ = 0.02 * count_ / std::sqrt(0.7 * most) / (last() + 1);
  steps_ = 0;
  begin_step();
}

TimingBarrier::Local TimingBarrier::local(const double* z, int place) const noexcept {
  z += place / per_knot_;
  if (place % per_knot_ == 0) {
    return {(z[0] + 4 * z[1] + z[2]) / 6, (z[2] - z[0]) / 2, z[0] - 2 * z[1] + z[2]};
  }
  return {(z[0] + z[3] + 23 * (z[1] + z[2])) / 48, (z[3] - z[0] + 5 * (z[2] - z[1])) / 8,
          (z[0] - z[1] - z[2] + z[3]) / 2};
}

// The function to be minimized: the duration and the barrier; infinite beyond a limit.
double TimingBarrier::height(const double* z) const noexcept {
  double time = 0;
  double logs = 0;
  for (int i = 0; i <= last(); ++i) {
    const Local m = local(z, i);
    const TimingPlace& k = places_[at(i)];
    double product = k.fastest - m.w;
    if (!(m.w > 0) || !(product > 0)) {
      return HUGE_VAL;
    }
    product /= k.fastest;
    const double root = 1 / std::sqrt(m.w);
    double least = 1;
    for (std::size_t r = 0; r < kRows; ++r) {
      const double a = k.bend[r] * m.w + k.drive[r] * m.d;
      const double j = (k.third[r] * m.w + k.mixed[r] * m.d + k.last[r] * m.dd) / root;
      least = std::min({least, 1 - a, 1 + a, 1 - j, 1 + j});
      product *= (1 - a * a) * (1 - j * j);
    }
    for (int v = 0; v < vectors_; ++v) {
      double a = 1;
      double j = 1;
      for (std::size_t r = row_of(v); r < row_of(v + 1); ++r) {
        const double one = k.bend[r] * m.w + k.drive[r] * m.d;
        const double other = (k.third[r] * m.w + k.mixed[r] * m.d + k.last[r] * m.dd) / root;
        a -= one * one;
        j -= other * other;
      }
      least = std::min({least, a, j});
      product *= a * j;
    }
    if (!(least > 0)) {
      return HUGE_VAL;
    }
    time += share(i) * root;
    logs += std::log(product) + 2 * (kRows + vectors_) * std::log(root);
  }
  const double first = z[2] - z[0];
  const double last = z[count_ + 2] - z[count_];
  return time - weight_ * logs + stiff_ / 2 * (first * first + last * last);
}

// At rest no limit determines how the parameter's speed changes: it is kept constant.
void TimingBarrier::hold_ends() noexcept {
  for (const int i : {0, count_}) {
    const double change = z_[at(i + 2)] - z_[at(i)];
    gradient_[at(i + 2)] += stiff_ * change;
    gradient_[at(i)] -= stiff_ * change;
    band_[at(i + 2)][0] += stiff_;
    band_[at(i)][0] += stiff_;
    band_[at(i + 2)][2] -= stiff_;
  }
}

void TimingBarrier::add_row(const TimingPlace& k, std::size_t r, const Local& m, double root,
                            Curve& curve) const noexcept {
  const double fall = -0.5 * root / m.w;  // derivative of the root
  auto& [g, h] = curve;
  const double p = k.bend[r];
  const double d = k.drive[r];
  const double a = p * m.w + d * m.d;
  const double up = 1 / (1 - a);
  const double down = 1 / (1 + a);
  const double slope = weight_ * (up - down);
  const double bend = weight_ * (up * up + down * down);
  g[0] += slope * p;
  g[1] += slope * d;
  h[0][0] += bend * p * p;
  h[0][1] += bend * p * d;
  h[1][1] += bend * d * d;
  const double j = k.third[r] * m.w + k.mixed[r] * m.d + k.last[r] * m.dd;
  for (const double sign : {1.0, -1.0}) {
    const double one = weight_ / (root - sign * j);
    const double two = one * one / weight_;
    const double by[3] = {sign * k.third[r] - fall, sign * k.mixed[r], sign * k.last[r]};
    for (std::size_t i = 0; i < 3; ++i) {
      g[i] += one * by[i];
      for (std::size_t n = i; n < 3; ++n) {
        h[i][n] += two * by[i] * by[n];
      }
    }
  }
}

// What is left of the square of the greatest length is the argument of the logarithm.
void TimingBarrier::add_vector(const TimingPlace& k, std::size_t first, const Local& m, Curve& curve) const noexcept {
  using Derivative = Vec3;  // by w, w' and w''
  auto& [g, h] = curve;
  const double square = 1 / m.w;  // of the root, by which jerk is divided
  double a = 1;
  double j = square;
  Derivative da = Derivative::Zero();
  Derivative dj(-square * square, 0, 0);
  Mat3 squares_of_a = Mat3::Zero();
  Mat3 squares_of_j = Mat3::Zero();
  for (std::size_t r = first; r < first + 3; ++r) {
    const Derivative by_a(k.bend[r], k.drive[r], 0);
    const Derivative by_j(k.third[r], k.mixed[r], k.last[r]);
    const double one = by_a[0] * m.w + by_a[1] * m.d;
    const double other = by_j[0] * m.w + by_j[1] * m.d + by_j[2] * m.dd;
    a -= one * one;
    j -= other * other;
    da -= 2 * one * by_a;
    dj -= 2 * other * by_j;
    squares_of_a += by_a * by_a.transpose();
    squares_of_j += by_j * by_j.transpose();
  }
  const Derivative slope = -weight_ * (da / a + dj / j);
  const Mat3 bend = weight_ * (da * da.transpose() / (a * a) + dj * dj.transpose() / (j * j) + 2 * squares_of_a / a +
                               2 * squares_of_j / j);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    g[i] += slope[row];
    for (std::size_t n = i; n < 3; ++n) {
      h[i][n] += bend(row, static_cast<Eigen::Index>(n));
    }
  }
}

// Adds the contribution of this place to gradient and curvature.
void TimingBarrier::derive(int place) noexcept {
  const TimingPlace& k = places_[at(place)];
  const Local m = local(z_.data(), place);
  const double root = 1 / std::sqrt(m.w);
  const double left = weight_ / (k.fastest - m.w);
  Curve curve;
  auto& [g, h] = curve;
  g[0] = left - 0.5 * share(place) * root / m.w;
  h[0][0] = left * left / weight_ + 0.75 * share(place) * root / (m.w * m.w);
  for (std::size_t r = 0; r < kRows; ++r) {
    add_row(k, r, m, root, curve);
  }
  for (int v = 0; v < vectors_; ++v) {
    add_vector(k, row_of(v), m, curve);
  }
  h[1][0] = h[0][1];
  h[2][0] = h[0][2];
  h[2][1] = h[1][2];
  add(place, curve);
}

// Converts to derivatives with respect to the coefficients.
void TimingBarrier::add(int place, const Curve& curve) noexcept {
  static constexpr double kAtKnot[3][3] = {{1.0 / 6, -0.5, 1}, {4.0 / 6, 0, -2}, {1.0 / 6, 0.5, 1}};
  static constexpr double kHalfWay[4][3] = {
      {1.0 / 48, -0.125, 0.5}, {23.0 / 48, -0.625, -0.5}, {23.0 / 48, 0.625, -0.5}, {1.0 / 48, 0.125, 0.5}};
  const int knot = place / per_knot_;
  const bool at_knot = place % per_knot_ == 0;
  const auto* by = at_knot ? kAtKnot : kHalfWay;
  for (int i = 0; i < (at_knot ? 3 : 4); ++i) {
    const double* b = by[i];
    gradient_[at(knot + i)] += b[0] * curve.slope[0] + b[1] * curve.slope[1] + b[2] * curve.slope[2];
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = b[0] * curve.bend[0][k] + b[1] * curve.bend[1][k] + b[2] * curve.bend[2][k];
    }
    for (int n = 0; n <= i; ++n) {
      band_[at(knot + i)][at(i - n)] += by[n][0] * along[0] + by[n][1] * along[1] + by[n][2] * along[2];
    }
  }
}

// The banded system, by square-free Cholesky factors in place.
bool TimingBarrier::solve() noexcept {
  const int n = count_ + 3;
  for (int i = 0; i < n; ++i) {
    auto& row = band_[at(i)];
    double sum = -gradient_[at(i)];
    // Begins with the farthest; each still has its pivot while the nearer ones need it.
    const int band = std::min(i, kBand - 1);
    for (int far = band; far > 0; --far) {
      for (int other = band; other > far; --other) {
        row[at(far)] -= row[at(other)] * band_[at(i - far)][at(other - far)];
      }
    }
    for (int far = band; far > 0; --far) {
      const double factor = row[at(far)] / band_[at(i - far)][0];
      row[0] -= factor * row[at(far)];
      row[at(far)] = factor;
      sum -= factor * direction_[at(i - far)];
    }
    if (!(row[0] > 0)) {
      return false;
    }
    direction_[at(i)] = sum;
  }
  for (int i = n - 1; i >= 0; --i) {
    double& x = direction_[at(i)];
    x /= band_[at(i)][0];
    for (int far = 1; far < kBand && i + far < n; ++far) {
      x -= band_[at(i + far)][at(far)] * direction_[at(i + far)];
    }
  }
  return true;
}

void TimingBarrier::begin_step() noexcept {
  const int n = count_ + 3;
  std::fill_n(gradient_.begin(), n, 0.0);
  std::fill_n(band_.begin(), n, std::array<double, kBand>{});
  next_ = 0;
  stage_ = Stage::Derive;
}

// Finds the descent direction and the present height.
void TimingBarrier::find_direction() noexcept {
  hold_ends();
  here_ = height(z_.data());
  decrement_ = 0;
  length_ = solve() ? 1 : 0;
  for (int i = 0; i < count_ + 3 && length_ > 0; ++i) {
    decrement_ -= gradient_[at(i)] * direction_[at(i)];
  }
  stage_ = Stage::Descend;
}

void TimingBarrier::descend() noexcept {
  if (length_ > 1e-3) {
    for (int i = 0; i < count_ + 3; ++i) {
      trial_[at(i)] = z_[at(i)] + length_ * direction_[at(i)];
    }
    if (height(trial_.data()) >= here_ - 0.1 * length_ * decrement_) {
      length_ /= 2;
      return;
    }
    z_ = trial_;
  }
  end_step(length_ > 1e-3);
}

void TimingBarrier::end_step(bool better) noexcept {
  double duration = 0;
  for (int i = 0; i <= last(); ++i) {
    duration += share(i) / std::sqrt(local(z_.data(), i).w);
  }
  const bool fine = weight_ * (last() + 1) * 4 < kEnough * duration;
  if (++steps_ >= kMostSteps || (fine && (!better || decrement_ < weight_))) {
    stage_ = Stage::Done;
    return;
  }
  if (!better || decrement_ < 0.3 * weight_ * (last() + 1)) {
    weight_ *= fine ? 1 : 0.2;
  }
  begin_step();
}

int TimingBarrier::work() noexcept {
  switch (stage_) {
    case Stage::Derive: {
      const int to = std::min(next_ + 4 * kDerivedPerLook, last() + 1);
      for (; next_ < to; ++next_) {
        derive(next_);
      }
      stage_ = next_ > last() ? Stage::Solve : Stage::Derive;
      return 4;
    }
    case Stage::Solve:
      find_direction();
      return 1 + last() / kWeighedPerLook;
    case Stage::Descend:
      descend();
      return 1 + last() / kWeighedPerLook;
    case Stage::Done:
      break;
  }
  return 0;
}

}  // namespace indurop::robot
