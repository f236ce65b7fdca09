// SPDX-License-Identifier: Apache-2.0
// The part of the space that this robot holds among those of its node, and the motions that wait for cells which other
// robots hold. A planned motion is granted as a whole, before it begins. Whatever else moves the arm is followed in
// each period: the cells up to where it can come to rest.
//
// Robots that wait are served in the order in which they began to wait. A robot whose next motion crosses cells that
// another one has wanted for longer waits too, unless it would stand in its way.

#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "control/robot/group/robot.h"
#include "control/robot/kinematics/zeroed.h"
#include "control/robot/plan/planning_desk.h"
#include "control/robot/space/arm_cells.h"

namespace indurop::robot {

class SharedSpace {
 public:
  using Others = std::array<const SpaceReport*, kOtherRobots>;

  // Allocates if the space is shared; no other function of this class does, and all of them are real-time safe.
  explicit SharedSpace(const Robot& robot);
  SharedSpace(const SharedSpace&) = delete;
  SharedSpace& operator=(const SharedSpace&) = delete;

  [[nodiscard]] bool on() const noexcept { return !memory_.empty(); }
  // Null: the space is not shared.
  [[nodiscard]] const CellGrid* grid() const noexcept { return on() ? &grid_ : nullptr; }
  // Calls add(vector) for the memory that changes, see KeptImage.
  template <class Add>
  void blocks(const Add& add) {
    if (on()) {
      add(memory_);
    }
  }
  // The paths of jobs that were interrupted, whose cells are not used for anything else meanwhile.
  void set_left(std::span<const KeptPath> left) noexcept { left_ = left; }

  // Takes the reports of the other robots. Returns whether one of them has come into the cells of this robot since the
  // last period; text() says which. `held`: this robot would not move now.
  [[nodiscard]] bool sense(const Others& others, std::uint64_t tick, bool held) noexcept;
  // Memory for the cells of a motion that is about to be planned; null: there is none, or the space is not shared.
  [[nodiscard]] SpaceCells* cells_for_plan(const PlanningDesk& desk) noexcept;

  // Requests the cells of a motion, in each period until they are granted. Deadlock: the robots wait for each other,
  // and this one began to wait last. Mismatch: the other robot has another box. text() says with which robot.
  enum class Answer { Granted, Waits, Deadlock, Mismatch };
  Answer request(const SpaceCells* cells) noexcept { return request(std::span(&cells, 1)); }
  Answer request(const PathPieces& path) noexcept;
  // The same for a motion whose cells are granted, until the other robots are ready for theirs of this name. They get
  // the answer in the same tick, if the periods of their modules are the same.
  Answer meet(const SpaceCells* cells, std::string_view name) noexcept;

  // Checks the set points that are about to be sent, unless a granted motion leads to them. `off_path`: something moves
  // them away from the planned path. Returns false if the arm could come into the cells of another robot before it
  // comes to rest.
  [[nodiscard]] bool foresee(bool off_path) noexcept { return !on() || follow(off_path, false); }
  // Ends the period: sets the report. Where the arm is or will be is reported even if another robot holds these cells.
  void step(bool off_path) noexcept;

  // Null: the space is not shared.
  [[nodiscard]] const SpaceReport* report() const noexcept { return on() ? &own() : nullptr; }
  // The reason of the last answer, or of the last `false`. Valid until the next call.
  [[nodiscard]] const char* text() const noexcept { return text_; }

 private:
  static constexpr double kLag = 0.25;  // s, by which drives are behind their set points at most

  struct Memory {
    SpaceReport own;
    SpaceCells ahead{};            // where the arm is, and where it may be before it comes to rest
    SpaceCells here{};             // these, and those of granted motions
    SpaceCells recent{}, older{};  // of motions that have ended: drives lag behind
    SpaceCells next{};             // being computed
    // Of all paths (followed, kept, interrupted), and of those that are being planned.
    std::array<SpaceCells, (2 + kMaxPriorities) * PathPieces::kMaxSegments + 3> plans{};
  };
  // The way for which `ahead` was computed: from the place that the drives report over the last set points to where the
  // axes come to rest if all of them brake now.
  struct Way {
    static constexpr std::size_t kPlaces = 10;
    bool known = false;
    int tool = 0;
    std::array<Joints, kPlaces> places{};
    double more = 0;  // m around the bodies
  };

  [[nodiscard]] SpaceReport& own() noexcept { return memory_.front().own; }
  [[nodiscard]] const SpaceReport& own() const noexcept { return memory_.front().own; }
  [[nodiscard]] const SpaceReport* other(std::string_view name) const noexcept;
  [[nodiscard]] const std::string& name(std::size_t other) const noexcept {
    return robot_.parts.settings.other_robots[other];
  }
  Answer request(std::span<const SpaceCells* const> cells) noexcept;
  [[nodiscard]] bool is_free(const SpaceReport& other, const SpaceCells& cells) noexcept;
  [[nodiscard]] bool is_older(const SpaceReport& other) const noexcept;
  Answer wait_for(std::size_t other, const SpaceCells& cells) noexcept;
  [[nodiscard]] bool loses_deadlock() const noexcept;
  [[nodiscard]] int periods(double seconds) const noexcept {
    return static_cast<int>(std::ceil(seconds / robot_.period));
  }
  void say(const char* before, std::string_view name, const char* after, std::string_view end = "") noexcept;

  [[nodiscard]] bool is_granted(bool off_path) const noexcept;
  [[nodiscard]] Way way() const noexcept;
  [[nodiscard]] bool covers(const Way& way) const noexcept;
  bool follow(bool off_path, bool forced) noexcept;
  void stamp(const Way& way) noexcept;
  bool enters_others(bool counts) noexcept;
  void age() noexcept;
  void note_motions() noexcept;
  void take(const SpaceCells& cells) noexcept;
  void hold() noexcept;

  const Robot& robot_;
  CellGrid grid_;
  ArmCells arm_;
  std::vector<Memory, Zeroed<Memory>> memory_;  // one, if the space is shared
  Others others_{};
  std::array<std::uint32_t, kOtherRobots> intrusions_{};  // seen, of each other robot
  std::array<bool, kOtherRobots> seen_{};
  std::span<const KeptPath> left_;
  std::array<const SpaceCells*, PathPieces::kMaxSegments> motions_{};  // followed in the last period
  Way way_;
  const SpaceCells* granted_ = nullptr;  // of a motion that does not begin yet
  std::uint64_t tick_ = 0;
  std::array<std::uint64_t, kOtherRobots> met_{};  // SpaceReport::sync_since of the last motions that began together
  bool changed_ = true;
  bool requested_ = false;  // in this period
  bool held_ = false;
  // Periods.
  int deadlocked_ = 0;
  int age_ = 0;
  int met_for_ = 0;  // during which the others see that this robot was ready
  int lags_ = 0;     // during which the arm may still be on a motion that was granted
  char text_[110] = "";
};

}  // namespace indurop::robot
