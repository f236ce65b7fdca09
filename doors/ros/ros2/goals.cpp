// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/goals.h"

#include <algorithm>

namespace indurop::ros {
namespace {

template <class Goals, class Is>
Goal* found_in(Goals& goals, Is is) noexcept {
  const auto found = std::find_if(goals.begin(), goals.end(), is);
  return found == goals.end() ? nullptr : &*found;
}

}  // namespace

Goal* GoalBook::add(const GoalId& id) {
  if (find(id) != nullptr) {
    return nullptr;
  }
  Goal& goal = goals_.emplace_back();
  goal.number = ++last_;
  goal.id = id;
  return &goal;
}

Goal* GoalBook::find(int number) noexcept {
  return found_in(goals_, [number](const Goal& goal) { return goal.number == number; });
}

Goal* GoalBook::find(const GoalId& id) noexcept {
  return found_in(goals_, [&id](const Goal& goal) { return goal.id == id; });
}

void GoalBook::remove(int number) {
  goals_.remove_if([number](const Goal& goal) { return goal.number == number; });
}

void GoalBook::tidy() {
  auto ended = static_cast<std::size_t>(
      std::count_if(goals_.begin(), goals_.end(), [](const Goal& goal) { return has_ended(goal.status); }));
  goals_.remove_if([&ended](const Goal& goal) { return has_ended(goal.status) && ended > kKept && ended-- > 0; });
}

GoalBook::Chosen GoalBook::chosen_to_cancel(const GoalId& id, std::int64_t stamp_ns) {
  const bool has_id = id != GoalId{};
  Chosen chosen;
  for (Goal& goal : goals_) {
    const bool is_named = has_id && goal.id == id;
    const bool is_old = goal.status != GoalStatus::Unknown && stamp_ns != 0 && goal.stamp_ns <= stamp_ns;
    if (!has_ended(goal.status) && (is_named || is_old || (!has_id && stamp_ns == 0))) {
      chosen.goals.push_back(&goal);
    }
  }
  if (has_id && chosen.goals.empty()) {
    chosen.code = find(id) == nullptr ? CancelCode::UnknownGoal : CancelCode::GoalHasEnded;
  }
  return chosen;
}

std::vector<const Goal*> GoalBook::shown() const {
  std::vector<const Goal*> shown;
  for (const Goal& goal : goals_) {
    if (goal.status != GoalStatus::Unknown) {
      shown.push_back(&goal);
    }
  }
  return shown;
}

}  // namespace indurop::ros
