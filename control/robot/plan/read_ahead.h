// SPDX-License-Identifier: Apache-2.0
// Motions of a job that wait to be planned. Lines with zones become one chain: as many as the job gives before another
// kind of step. The points of a spline become one chain too. A free motion gets the memory for its path.

#pragma once

#include <array>
#include <vector>

#include "control/robot/kinematics/zeroed.h"
#include "control/robot/path/chain.h"
#include "control/robot/path/segment.h"
#include "control/robot/path/spline.h"

namespace indurop::robot {

class ReadAhead {
 public:
  // Allocates; no other function of this class does.
  ReadAhead(const Places& places, const ToolLimits& tool);

  void clear() noexcept;
  // Exchanges the motions of both; chains and splines stay where they are.
  void swap(ReadAhead& other) noexcept;
  // Calls add(vector) for the memory that changes, see KeptImage.
  template <class Add>
  void blocks(const Add& add) {
    add(commands_);
    add(chains_);
    add(splines_);
    add(joint_paths_);
  }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] int count() const noexcept { return count_; }
  // Returns whether there is room: for a few motions, but for many if they are lines with zones or points of a spline.
  [[nodiscard]] bool has_room() const noexcept;
  // MoveCommand::source of the first motion; 0: there is none.
  [[nodiscard]] int source() const noexcept { return empty() ? 0 : command(0).source; }
  // Adds a motion; requires has_room().
  void add(const MoveCommand& command) noexcept;

  // The next motion to plan: a chain or a command, or neither while it may still become longer.
  struct Next {
    const ToolPath* chain = nullptr;       // is not changed while five others are taken
    const MoveCommand* command = nullptr;  // with a chain of lines: the first of them
    std::uint32_t ticket = 0;              // of a spline
    double acceleration = 1;               // of a chain, as MoveCommand::acceleration
    const Chain* lines = nullptr;          // the chain, if it consists of lines
    const MoveCommand* then = nullptr;     // the motion after a command, if it is known and begins no chain
    Wave wave{};                           // of a spline
    JointPath* joint_path = nullptr;       // of a free motion, for its path; is not used while five others are taken
  };
  // Returns the next motion, which begins at `from`. `more`: other motions may follow at once.
  Next next(const Joints& from, bool more) noexcept;
  // Records that the lines of the last chain are followed as it; or one by one, with stops, of which the first one has
  // been planned.
  void joined() noexcept { given_ = 0; }
  void parted() noexcept;

 private:
  static constexpr int kAhead = 3;
  [[nodiscard]] const MoveCommand& command(int i) const noexcept;
  void begin_scan(const Joints& from) noexcept;
  void scan() noexcept;
  [[nodiscard]] bool belongs(const MoveCommand& command) const noexcept;
  const MoveCommand& take() noexcept;
  Next next_spline(const Joints& from) noexcept;
  Next next_chain() noexcept;
  Next next_single() noexcept;
  [[nodiscard]] Pose pose_of(const Target& target) const noexcept;

  const Places& places_;
  ToolLimits tool_;
  std::vector<MoveCommand, Zeroed<MoveCommand>> commands_;  // a ring
  int first_ = 0;
  int count_ = 0;
  int scanned_ = 0;  // motions from the first on that are in the present chain
  int single_ = 0;   // motions from the first on that form no chain
  int given_ = 0;    // motions before the first that are planned as a chain, and may still be parted
  bool closed_ = false;
  std::vector<Chain, Zeroed<Chain>> chains_;
  std::size_t chain_ = 0;
  std::vector<Spline, Zeroed<Spline>> splines_;
  std::size_t spline_ = 0;
  std::vector<JointPath, Zeroed<JointPath>> joint_paths_;
  std::size_t joint_path_ = 0;
};

}  // namespace indurop::robot
