// SPDX-License-Identifier: Apache-2.0
// The path that is followed, and the place on it: the present segment, the next ones, and the blend between the first
// two. It knows nothing of override, hold and stop. Real-time safe.

#pragma once

#include <array>

#include "control/robot/path/brake.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

// The segments of a path, from the present one on. The present piece is the first segment up to the blend, or the
// blend.
struct PathPieces {
  static constexpr int kMaxSegments = 3;
  std::array<Segment, kMaxSegments> segments;
  std::array<Blend, kMaxSegments> blends;  // into each of them, if it is still possible when it is near
  int count = 0;
  [[nodiscard]] bool full() const noexcept { return count == kMaxSegments; }
  Blend blend;            // between the first two segments; zone 0: none
  bool in_blend = false;  // the present piece is the blend, not the first segment

  // Takes the segments of another path.
  void copy(const PathPieces& other) noexcept;
};

// The rest of a path that was left before its end.
struct KeptPath {
  PathPieces pieces;
  double place = 0;  // on the present piece
  Joints q = Joints::Zero();
  // Returns whether there is a rest.
  [[nodiscard]] bool known() const noexcept { return pieces.count > 0; }
  // MoveCommand::source of the place where it was left; 0: none.
  [[nodiscard]] int source() const noexcept;
};

// The speed in a blend after which it is possible to stop on the next segment, should that be the last one.
double blend_speed(const Blend& blend, const Segment& next) noexcept;

class FollowedPath final : public PathAhead {
 public:
  // A speed below this part of the planned one is none.
  static constexpr double kStill = 1e-3;

  // The places are borrowed.
  explicit FollowedPath(const Places& places) noexcept : places_(places) {}

  [[nodiscard]] bool empty() const noexcept { return pieces_.count == 0; }
  [[nodiscard]] const PathPieces& pieces() const noexcept { return pieces_; }
  void clear() noexcept;
  // The path continues with this segment after its last one.
  void add(const Segment& segment, const Blend& blend) noexcept;
  // Replaces what is reported of the last segment, if there is one.
  void set_way(const ToolWay* way) noexcept;
  // The path is this segment only, at this state.
  void replace(const Segment& segment, const LineState& state) noexcept;
  // The path is a kept one, at rest at the place where it was left; it is followed more gently from there on. The kept
  // one is empty then. Not for an empty one.
  void take(KeptPath& kept) noexcept;
  // `q`: the present set point.
  void keep(const Joints& q, KeptPath& kept) const noexcept;

  // The present segment, which is the one before the blend while that is followed.
  [[nodiscard]] const Segment& segment() const noexcept { return pieces_.segments[0]; }
  [[nodiscard]] Segment& segment() noexcept { return pieces_.segments[0]; }
  [[nodiscard]] const Segment& last() const noexcept;
  // Returns whether the present segment is a joint motion that follows its timing.
  [[nodiscard]] bool joints_timed() const noexcept { return segment().timed && segment().move == Move::Joint; }
  // Returns whether the rest of the path is a straight line between joint angles, with the same limits everywhere.
  [[nodiscard]] bool is_straight() const noexcept {
    return segment().move == Move::Joint && !segment().timed && !is_blended();
  }
  [[nodiscard]] const Blend& blend() const noexcept { return pieces_.blend; }
  [[nodiscard]] bool in_blend() const noexcept { return pieces_.in_blend; }
  // Decides whether the first two segments are blended, as long as the blend's speed can still be reached. Returns
  // whether they are from now on.
  bool begin_blend() noexcept;

  // Position: place on the present piece.
  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  void set_state(const LineState& state) noexcept { state_ = state; }
  // Length and limits of the present piece, and the tip speed on it at full speed.
  [[nodiscard]] double piece_end() const noexcept;
  [[nodiscard]] const LineLimits& piece_limits() const noexcept;
  [[nodiscard]] double tip_speed() const noexcept;
  // Goes on to the next piece. Returns whether that is a segment.
  bool next_piece() noexcept;
  // Moves along the path, over the ends of pieces.
  void go(double distance) noexcept;
  // Plans to the beginning of the blend, at the lowest possible speed there.
  [[nodiscard]] Profile into_blend() const noexcept;
  // The piece begins to follow its timing at rest.
  void begin_timing() noexcept { passed_.fill(0); }
  // Called once per period on a line or circle with a timing. Returns how far it has moved since the last call.
  double note_passed() noexcept;

  // The joint angles at a place of the present piece.
  Reach joints_at(double place, const Joints& near, Joints& q) const noexcept;
  // Computes the motion of the joints, which are at `q` now.
  Reach motion(const Joints& q, JointState& now) const noexcept;
  // MoveCommand::source of the present place; 0: none.
  [[nodiscard]] int source() const noexcept;
  // The place on the present motion, which in a blend is the one before it.
  [[nodiscard]] PathPlace place(double to_go) const noexcept;

  Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept override;
  [[nodiscard]] double left() const noexcept override;
  [[nodiscard]] bool has_shape() const noexcept override { return joints_timed(); }
  [[nodiscard]] Shape shape_ahead(double distance) const noexcept override;
  [[nodiscard]] double smooth_until(double distance) const noexcept override;
  [[nodiscard]] bool is_timed() const noexcept override { return segment().timed && segment().move != Move::Joint; }
  [[nodiscard]] Timed timed_ahead(double distance) const noexcept override;
  Reach joints_on_path(double along, const Joints& near, Joints& q) const noexcept override;

 private:
  // Returns whether the path continues beyond the present piece without a stop.
  [[nodiscard]] bool is_blended() const noexcept { return pieces_.count >= 2 && (blend().zone > 0 || in_blend()); }

  const Places& places_;
  PathPieces pieces_;
  LineState state_;
  std::array<double, 2> passed_{};  // the last places on a piece with a timing, the latest first
};

}  // namespace indurop::robot
