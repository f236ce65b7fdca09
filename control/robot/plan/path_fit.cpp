// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "control/robot/kinematics/dexterity.h"
#include "control/robot/path/spline.h"

namespace indurop::robot {
namespace {

constexpr int kFine = 24;           // places of a motion that are compared, for each piece of it
constexpr std::size_t kMost = 96;   // places of a spline
constexpr double kLever = 0.2;      // m: turns of the tool count as motions of a point that far from it
constexpr double kSingular = 0.02;  // m per rad, the slowest direction of the tool

using Poses = std::vector<Pose>;

// Distance of a pose from a chain of poses: of the nearest place on it, and how it is turned there.
FitTolerance distance(const Pose& from, std::span<const Pose> chain, double per_turn) {
  FitTolerance nearest{HUGE_VAL, HUGE_VAL};
  double best = HUGE_VAL;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Pose& a = chain[i];
    const Pose& b = chain[i + 1 < chain.size() ? i + 1 : i];
    const Vec3 way = b.position - a.position;
    const double size = way.squaredNorm();
    const double part = size > 0 ? std::clamp((from.position - a.position).dot(way) / size, 0.0, 1.0) : 0;
    const double off = (a.position + part * way - from.position).norm();
    const double turn = rotation_between(a.orientation.slerp(part, b.orientation), from.orientation).norm();
    if (const double both = std::max(off, turn * per_turn); both < best) {
      best = both;
      nearest = {off, turn};
    }
  }
  return nearest;
}

FitTolerance larger(const FitTolerance& a, const FitTolerance& b) {
  return {std::max(a.way, b.way), std::max(a.turn, b.turn)};
}

class Fitting {
 public:
  Fitting(std::span<const FitPlace> path, const FitTolerance& tolerance, const Arm& arm, const ToolLimits& tool)
      : path_(path), tolerance_(tolerance), arm_(arm), tool_(tool), per_turn_(tolerance.way / tolerance.turn) {}

  // The motions from one mark to the next.
  void fit(std::size_t from, std::size_t to) {
    const bool singular = is_singular(from, to);
    if ((!singular && try_one(FitKind::Line, from, to, line(from, to))) ||
        try_one(FitKind::Axes, from, to, axes(from, to))) {
      return;
    }
    if (singular) {
      fit_axes(from, to);
      return;
    }
    std::vector<std::size_t> through{from, to};
    if (to > from + 1) {
      through.insert(through.begin() + 1, (from + to) / 2);
    }
    while (true) {
      const auto worst = spline(through);
      if (!worst) {
        out_.motions.push_back({FitKind::Spline, {through.begin() + 1, through.end()}});
        out_.off = larger(out_.off, off_);
        return;
      }
      if (through.size() > kMost) {
        const std::size_t middle = through[through.size() / 2];
        fit(from, middle);
        fit(middle, to);
        return;
      }
      through.insert(std::upper_bound(through.begin(), through.end(), *worst), *worst);
    }
  }
  [[nodiscard]] FittedPath take() { return std::move(out_); }

 private:
  // Returns whether the path comes near a place where the tool cannot go in each direction: there only the axes can
  // follow it.
  [[nodiscard]] bool is_singular(std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i <= to && arm_.count() >= 6; ++i) {
      if (slowest_direction(arm_, path_[i].q, kLever) < kSingular) {
        return true;
      }
    }
    return false;
  }
  // Straight lines of the axes, each as long as the tolerance allows.
  void fit_axes(std::size_t from, std::size_t to) {
    while (from < to) {
      std::size_t good = from + 1;
      std::size_t bad = to + 1;
      while (bad - good > 1) {
        const std::size_t middle = (good + bad) / 2;
        if (fits(apart(axes(from, middle), guided(from, middle)))) {
          good = middle;
        } else {
          bad = middle;
        }
      }
      out_.off = larger(out_.off, apart(axes(from, good), guided(from, good)));
      out_.motions.push_back({FitKind::Axes, {good}});
      from = good;
    }
  }
  [[nodiscard]] bool fits(const FitTolerance& off) const {
    return off.way <= tolerance_.way && off.turn <= tolerance_.turn;
  }
  [[nodiscard]] Poses guided(std::size_t from, std::size_t to) const {
    Poses poses;
    for (std::size_t i = from; i <= to; ++i) {
      poses.push_back(path_[i].tip);
    }
    return poses;
  }
  [[nodiscard]] Poses line(std::size_t from, std::size_t to) const {
    Poses poses;
    for (int k = 0; k <= kFine; ++k) {
      const double part = static_cast<double>(k) / kFine;
      const Pose& a = path_[from].tip;
      const Pose& b = path_[to].tip;
      poses.push_back({a.position + part * (b.position - a.position), a.orientation.slerp(part, b.orientation)});
    }
    return poses;
  }
  [[nodiscard]] Poses axes(std::size_t from, std::size_t to) const {
    Poses poses;
    for (int k = 0; k <= 4 * kFine; ++k) {
      const double part = static_cast<double>(k) / (4 * kFine);
      poses.push_back(arm_.forward(path_[from].q + part * (path_[to].q - path_[from].q)));
    }
    return poses;
  }
  // How far two ways with the same ends are apart, seen from both.
  [[nodiscard]] FitTolerance apart(const Poses& played, const Poses& wanted) const {
    FitTolerance off{0, 0};
    for (const Pose& one : wanted) {
      off = larger(off, distance(one, played, per_turn_));
    }
    for (const Pose& one : played) {
      off = larger(off, distance(one, wanted, per_turn_));
    }
    return off;
  }
  bool try_one(FitKind kind, std::size_t from, std::size_t to, const Poses& played) {
    const FitTolerance off = apart(played, guided(from, to));
    if (!fits(off)) {
      return false;
    }
    out_.motions.push_back({kind, {to}});
    out_.off = larger(out_.off, off);
    return true;
  }
  // Returns the place at which the spline through these has to pass the path, too; none: it is within the tolerance,
  // or passes all places.
  std::optional<std::size_t> spline(const std::vector<std::size_t>& through) {
    spline_.begin(path_[through[0]].tip, tool_);
    for (std::size_t i = 1; i < through.size(); ++i) {
      if (!spline_.add({path_[through[i]].tip, 1, 0, 0})) {
        return std::nullopt;  // places that are the same are left out before
      }
    }
    spline_.finish();
    off_ = {0, 0};
    std::optional<std::size_t> worst;
    double most = 1;
    for (std::size_t i = 0; i + 1 < through.size(); ++i) {
      const std::size_t from = through[i];
      const std::size_t to = through[i + 1];
      const double begin = spline_.place_of(static_cast<int>(i));
      const double length = spline_.place_of(static_cast<int>(i) + 1) - begin;
      Poses played;
      for (int k = 0; k <= kFine; ++k) {
        played.push_back(spline_.pose_at(begin + length * k / kFine));
      }
      const FitTolerance off = apart(played, guided(from, to));
      off_ = larger(off_, off);
      const double part = std::max(off.way / tolerance_.way, off.turn / tolerance_.turn);
      if (part > most && to > from + 1) {
        most = part;
        worst = (from + to) / 2;
      }
    }
    return worst;
  }

  std::span<const FitPlace> path_;
  FitTolerance tolerance_;
  const Arm& arm_;
  ToolLimits tool_;
  double per_turn_;  // m that count as much as a rad
  FittedPath out_;
  Spline spline_;
  FitTolerance off_{0, 0};  // of the last spline
};

}  // namespace

FittedPath fit_path(std::span<const FitPlace> path, const FitTolerance& tolerance, const Arm& arm,
                    const ToolLimits& tool) {
  Fitting fitting(path, tolerance, arm, tool);
  std::size_t from = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].marked || i + 1 == path.size()) {
      fitting.fit(from, i);
      from = i;
    }
  }
  return fitting.take();
}

}  // namespace indurop::robot
