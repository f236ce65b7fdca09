// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/step_needs.h"

#include <algorithm>
#include <span>

namespace indurop::robot {

namespace {

constexpr int kPartsPerStep = 4;   // of formulas; a longer formula counts as several steps
constexpr int kPartsOfPlace = 16;  // that a computed place counts as

std::span<const Formula> formulas_of(const JobBook& book, const Step& step) noexcept {
  if (step.formula < 0) {
    return {};
  }
  const auto first = static_cast<std::size_t>(step.formula);
  switch (step.op) {
    case Op::Call:
      return std::span(book.formulas).subspan(first, static_cast<std::size_t>(step.mid));
    case Op::Assign:
      return std::span(book.formulas).subspan(first, step.mid > 0 ? 2 : 1);
    case Op::Move:
      return std::span(book.formulas).subspan(first, step.turns ? 6 : 3);
    default:
      return std::span(book.formulas).subspan(first, 1);
  }
}

bool settings_read_world(const JobBook& book, const Step& motion) noexcept {
  const MotionExtras* const extras = book.extras_of(motion);
  return extras != nullptr && std::any_of(extras->settings.begin(), extras->settings.end(), [&](const Step& each) {
           return each.formula >= 0 && book.formulas[static_cast<std::size_t>(each.formula)].reads().world();
         });
}

// It begins at rest.
bool begins_with_others(const JobBook& book, const Step& motion) noexcept {
  const MotionExtras* const extras = book.extras_of(motion);
  return extras != nullptr && extras->sync >= 0;
}

}  // namespace

bool has_until(const JobBook& book, const Step& step) noexcept {
  const MotionExtras* const extras = step.op == Op::Move ? book.extras_of(step) : nullptr;
  return extras != nullptr && extras->until >= 0;
}

bool touches_world(const JobBook& book, const Step& step) noexcept {
  switch (step.op) {
    case Op::Set:
    case Op::Message:
    case Op::Raise:
    case Op::WaitUntil:
    case Op::WaitTime:
    case Op::Ask:
    case Op::Tool:
    case Op::Load:
    case Op::Weave:
    case Op::Correct:
    case Op::Push:
    case Op::Track:
    case Op::Arm:
    case Op::Follow:
    case Op::Disarm:
    case Op::Try:
    case Op::EndTry:
    case Op::Recover:
      return true;
    case Op::Place:
      return book.places[static_cast<std::size_t>(step.mid)].reads.world();
    case Op::Move:
      if (step.index == kHere || has_until(book, step) || begins_with_others(book, step) ||
          settings_read_world(book, step)) {
        return true;
      }
      break;
    default:
      break;
  }
  const auto formulas = formulas_of(book, step);
  return std::any_of(formulas.begin(), formulas.end(), [](const Formula& each) { return each.reads().world(); });
}

int cost_of(const JobBook& book, const Step& step) noexcept {
  int parts = step.op == Op::Place ? kPartsOfPlace : 0;
  for (const Formula& formula : formulas_of(book, step)) {
    parts += static_cast<int>(formula.size());
  }
  return 1 + parts / kPartsPerStep;
}

}  // namespace indurop::robot
