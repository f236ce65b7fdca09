// SPDX-License-Identifier: Apache-2.0
// The goals of an action as ROS 2 has them: their identifiers, states and results, and which of them a client cancels.
// Knows no DDS. For one thread.

#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace indurop::ros {

using GoalId = std::array<std::uint8_t, 16>;

// As action_msgs/msg/GoalStatus numbers them.
enum class GoalStatus : std::int8_t {
  Unknown = 0,
  Accepted = 1,
  Executing = 2,
  Canceling = 3,
  Succeeded = 4,
  Canceled = 5,
  Aborted = 6
};
constexpr bool has_ended(GoalStatus status) noexcept {
  return status >= GoalStatus::Succeeded;
}

struct Goal {
  int number = 0;  // from 1
  GoalId id{};
  std::int64_t stamp_ns = 0;  // when it was accepted, by the wall clock
  GoalStatus status = GoalStatus::Unknown;
  int code = 0;      // of the result
  std::string text;  // of the result
};

class GoalBook {
 public:
  // Ended goals whose results are kept.
  static constexpr std::size_t kKept = 32;

  // Returns the goal, or null: the identifier is in use. It is not accepted yet.
  Goal* add(const GoalId& id);
  Goal* find(int number) noexcept;
  Goal* find(const GoalId& id) noexcept;
  void remove(int number);
  // Forgets the oldest ended ones that are too many; goals that are not accepted yet are kept.
  void tidy();

  // What a request to cancel is about, by action_msgs/srv/CancelGoal: the goal with this identifier and those accepted
  // until then; zeros: all. Goals that are not accepted yet belong to these, so that they are not executed later.
  enum class CancelCode : std::int8_t { None = 0, Rejected = 1, UnknownGoal = 2, GoalHasEnded = 3 };
  struct Chosen {
    CancelCode code = CancelCode::None;
    std::vector<Goal*> goals;
  };
  Chosen chosen_to_cancel(const GoalId& id, std::int64_t stamp_ns);

  // Accepted and ended ones, the oldest first.
  [[nodiscard]] std::vector<const Goal*> shown() const;

 private:
  std::list<Goal> goals_;  // places do not change
  int last_ = 0;           // number that was given
};

}  // namespace indurop::ros
