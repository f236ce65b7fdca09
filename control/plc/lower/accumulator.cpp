// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/accumulator.h"

#include <fmt/format.h>

#include <utility>

#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"

namespace indurop::plc::lower {

using ast::Expression;

void Accumulator::load(Expression value) {
  value_ = std::move(value);
  used_ = false;
}

void Accumulator::combine(Expression value) {
  constexpr std::size_t kDeepest = 100;
  load(std::move(value));
  if (ast::depth_of(*value_) > kDeepest) {
    hold();
  }
}

void Accumulator::load_joint(const Place& at, const std::string& variable) {
  value_ = make::name(at, variable);
  used_ = true;
}

std::optional<Expression> Accumulator::take() {
  return std::exchange(value_, std::nullopt);
}

const Expression& Accumulator::use(bool follows) {
  used_ = true;
  const bool held = value_->kind == Expression::Kind::Name && value_->name.starts_with("_il");
  if (follows && !held && value_->kind != Expression::Kind::Literal) {
    hold();
  }
  return *value_;
}

void Accumulator::bring_to(const std::string& variable) {
  used_ = true;
  const Place at = value_->at;
  if (brought_.insert(variable).second) {
    lowered_.variables.push_back(make::variable(ast::Section::Temp, variable, make::inferred_type(at)));
  }
  lowered_.body.push_back(make::assign(make::name(at, variable), *value_));
}

void Accumulator::drop() {
  if (value_ && !used_ && value_->kind != Expression::Kind::Literal) {
    hold();
  }
  used_ = true;
}

void Accumulator::hold() {
  const Place at = value_->at;
  const std::string name = fmt::format("_il{}{}", prefix_, ++held_);
  lowered_.variables.push_back(make::variable(ast::Section::Temp, name, make::inferred_type(at)));
  lowered_.body.push_back(make::assign(make::name(at, name), std::move(*value_)));
  value_ = make::name(at, name);
}

}  // namespace indurop::plc::lower
