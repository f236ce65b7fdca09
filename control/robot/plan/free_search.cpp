// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/free_search.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// m in addition to the clearance, so that a proof of the path with other steps has the same result
constexpr double kRoom = 5e-4;
constexpr double kTipInside = 5e-3;   // m that the tip keeps from the sides of the workspace, for the same reason
constexpr double kSearchStep = 0.25;  // s at full speed, that a tree grows in one step
constexpr double kLeastStep = 0.02;   // part of a step: less is not worth a node
constexpr int kTriesPerGoal = 100;    // after which the next solution is a target, too
constexpr int kCuts = 150;            // attempts to shorten the way
constexpr double kCornerPart = 0.98;  // part of the room that a corner uses
constexpr double kSharpest = 2e-3;    // s: a corner that has to be sharper counts as not clear
constexpr int kTryPlaces = 8;         // places that one attempt counts as
constexpr double kInsideParts = 64;   // of a straight way: the longest step in a workspace

}  // namespace

Fault FreeSearch::begin(const Joints& from, const Solutions& goals, const Joints& velocity, std::uint32_t seed,
                        JointPath& path) {
  path_ = &path;
  path.begin(from);
  random_.seed(seed);
  from_ = from;
  velocity_ = velocity;
  tries_ = cuts_ = next_goal_ = 0;
  hits_.assign(places_.clearance().pairs().size(), 0);
  goals_.count = 0;
  int touches = -1;
  for (int i = 0; i < goals.count; ++i) {
    const Solution& goal = goals.list[at(i)];
    bodies_.begin(goal.q, places_.tool());
    if (bodies_.pair() < 0) {
      goals_.list[at(goals_.count++)] = goal;
    } else if (touches < 0) {
      touches = bodies_.pair();
    }
  }
  if (goals_.count == 0) {
    stage_ = Stage::Done;
    return {ErrorCode::Collision, 0, touches, 1};
  }
  for (Tree& tree : trees_) {
    tree.clear();
  }
  trees_[0].push_back({from, -1});
  add_goal();
  points_ = {from, goals_.list[0].q};
  stage_ = go(points_[0], points_[1]) < 1 ? Stage::Search : Stage::Round;
  return {};
}

void FreeSearch::add_goal() {
  trees_[1].push_back({goals_.list[at(next_goal_++)].q, -1});
}

double FreeSearch::chance() noexcept {
  return static_cast<double>(random_()) / 4294967296.0;
}

Joints FreeSearch::anywhere() noexcept {
  Joints q = from_;
  for (int i = 0; i < places_.arm().count(); ++i) {
    const Axis& axis = places_.arm().axis(i);
    double low = axis.endless ? from_[i] - kPi : axis.lower;
    double high = axis.endless ? from_[i] + kPi : axis.upper;
    if (places_.arm().moves_workpiece(i)) {
      low = from_[i];  // it is turned no farther than the motion says
      high = goals_.list[0].q[i];
    }
    q[i] = low + chance() * (high - low);
  }
  return q;
}

double FreeSearch::distance(const Joints& a, const Joints& b) const noexcept {
  return (a - b).cwiseQuotient(velocity_).squaredNorm();
}

int FreeSearch::nearest(const Tree& tree, const Joints& q) const noexcept {
  const auto nearer = [&](const Node& a, const Node& b) { return distance(a.q, q) < distance(b.q, q); };
  return static_cast<int>(std::min_element(tree.begin(), tree.end(), nearer) - tree.begin());
}

double FreeSearch::go(const Joints& from, const Joints& to) noexcept {
  const Joints way = to - from;
  const Workspace& box = places_.box();
  const double beyond = std::max(-kTipInside, box.outside(places_.arm().forward(from).position));
  bodies_.begin(from, places_.tool(), kRoom);
  double clear = 0;
  ClearWalk walk;
  for (walk.begin(1, box.known() ? 1 / kInsideParts : 1); !walk.done();) {
    const CollisionCheck::Step step = walk.step_along(
        bodies_, [&](double place) { return Joints(from + place * way); },
        [&](double begin, double end) { return Joints((end - begin) * way.cwiseAbs()); });
    if (step == CollisionCheck::Step::Touches) {
      ++hits_[static_cast<std::size_t>(bodies_.pair())];
      break;
    }
    if (step == CollisionCheck::Step::Lost || box.outside(places_.arm().forward(bodies_.at()).position) > beyond) {
      break;
    }
    clear = walk.place();
  }
  return clear;
}

int FreeSearch::extend(Tree& tree, int node, const Joints& to, bool& there) {
  const Joints from = tree[at(node)].q;
  const double far = std::sqrt(distance(from, to));
  const double part = std::min(1.0, kSearchStep / std::max(far, 1e-12));
  const Joints end = part < 1 ? Joints(from + part * (to - from)) : to;
  const double clear = go(from, end);
  there = part >= 1 && clear >= 1;
  if (clear < kLeastStep) {
    return -1;
  }
  tree.push_back({clear < 1 ? Joints(from + clear * (end - from)) : end, node});
  return static_cast<int>(tree.size()) - 1;
}

bool FreeSearch::grow() {
  Tree& tree = trees_[tries_ % 2];
  Tree& other = trees_[1 - tries_ % 2];
  ++tries_;
  const Joints towards = anywhere();
  bool there = false;
  const int node = extend(tree, nearest(tree, towards), towards, there);
  if (node < 0) {
    return false;
  }
  const Joints meeting = tree[at(node)].q;
  int last = nearest(other, meeting);
  for (there = other[at(last)].q == meeting; !there;) {
    last = extend(other, last, meeting, there);
    if (last < 0) {
      return false;
    }
  }
  if (&tree == &trees_[0]) {
    join(node, last);
  } else {
    join(last, node);
  }
  return true;
}

// Both nodes are at the same place.
void FreeSearch::join(int start_node, int goal_node) {
  points_.clear();
  for (int i = start_node; i >= 0; i = trees_[0][at(i)].before) {
    points_.push_back(trees_[0][at(i)].q);
  }
  std::reverse(points_.begin(), points_.end());
  for (int i = trees_[1][at(goal_node)].before; i >= 0; i = trees_[1][at(i)].before) {
    points_.push_back(trees_[1][at(i)].q);
  }
}

Fault FreeSearch::work(int& places) {
  for (; places > 0 && stage_ != Stage::Done; places -= kTryPlaces) {
    switch (stage_) {
      case Stage::Search:
        if (tries_ >= kMostTries) {
          return no_way();
        }
        if (next_goal_ < goals_.count && tries_ >= kTriesPerGoal * next_goal_) {
          add_goal();
        }
        stage_ = grow() ? Stage::Shorten : Stage::Search;
        break;
      case Stage::Shorten:
        shorten();
        break;
      case Stage::Round:
        if (const Fault fault = round(); !fault.ok()) {
          return fault;
        }
        break;
      case Stage::Done:
        break;
    }
  }
  return {};
}

// Replaces what is between two places of the way by a straight piece, if that is clear. At the end, each point is left
// out without which the way is clear, too.
void FreeSearch::shorten() {
  const std::size_t count = points_.size();
  if (count <= 2 || cuts_ >= kCuts + 2 * static_cast<int>(count)) {
    stage_ = Stage::Round;
    return;
  }
  const int cut = cuts_++;
  if (cut >= kCuts) {
    const std::size_t middle = 1 + static_cast<std::size_t>(cut - kCuts) % (count - 2);
    replace(middle - 1, 0, middle, 1);
    return;
  }
  double length = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    length += std::sqrt(distance(points_[i], points_[i + 1]));
  }
  double from = length * chance();
  double to = length * chance();
  if (from > to) {
    std::swap(from, to);
  }
  std::size_t first = 0;
  std::size_t last = 0;
  const auto piece = [&](double place, std::size_t& i) {
    for (i = 0;; ++i) {
      const double here = std::sqrt(distance(points_[i], points_[i + 1]));
      if (place <= here || i + 2 == count) {
        return here > 0 ? std::min(place / here, 1.0) : 0;
      }
      place -= here;
    }
  };
  const double first_part = piece(from, first);
  const double last_part = piece(to, last);
  if (last > first) {
    replace(first, first_part, last, last_part);
  }
}

bool FreeSearch::replace(std::size_t first, double first_part, std::size_t last, double last_part) {
  const Joints from = points_[first] + first_part * (points_[first + 1] - points_[first]);
  const Joints to =
      last_part < 1 ? Joints(points_[last] + last_part * (points_[last + 1] - points_[last])) : points_[last + 1];
  if (go(from, to) < 1) {
    return false;
  }
  std::vector<Joints> rest(points_.begin() + static_cast<std::ptrdiff_t>(last) + 1, points_.end());
  points_.resize(first + 1);
  if (first_part > 0) {
    points_.push_back(from);
  }
  if (last_part < 1) {
    points_.push_back(to);
  }
  points_.insert(points_.end(), rest.begin(), rest.end());
  return true;
}

// Each corner uses up to half of its pieces, or as much of that as is clear.
Fault FreeSearch::round() {
  stage_ = Stage::Done;
  path_->begin(points_[0]);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (!path_->add(points_[i], velocity_) && path_->points() == JointPath::kMostPoints) {
      return no_way();
    }
  }
  for (int i = 1; i + 1 < path_->points(); ++i) {
    double zone =
        kCornerPart / 2 * std::min(path_->place(i) - path_->place(i - 1), path_->place(i + 1) - path_->place(i));
    for (path_->round(i, zone); !is_clear(i); path_->round(i, zone)) {
      zone /= 2;
      if (zone < kSharpest) {
        return no_way();
      }
    }
  }
  return {};
}

bool FreeSearch::is_clear(int corner) noexcept {
  const double begin = path_->place(corner) - path_->zone(corner);
  const double length = 2 * path_->zone(corner);
  const Workspace& box = places_.box();
  bodies_.begin(path_->at(begin), places_.tool(), kRoom / 2);
  ClearWalk walk;
  for (walk.begin(length, length / 8); !walk.done();) {
    const CollisionCheck::Step step = walk.step_along(
        bodies_, [&](double place) { return path_->at(begin + place); },
        [&](double from, double to) { return path_->travel(begin + from, begin + to); });
    if (step == CollisionCheck::Step::Touches || step == CollisionCheck::Step::Lost ||
        box.outside(places_.arm().forward(bodies_.at()).position) > -kTipInside / 2) {
      return false;
    }
  }
  return true;
}

// Names the pair that was in the way most often.
Fault FreeSearch::no_way() const noexcept {
  const auto most = std::max_element(hits_.begin(), hits_.end());
  const int pair = most != hits_.end() && *most > 0 ? static_cast<int>(most - hits_.begin()) : -1;
  return {ErrorCode::NoWay, 0, pair, static_cast<double>(tries_)};
}

}  // namespace indurop::robot
