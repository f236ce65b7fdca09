// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/body_parts.h"

#include <algorithm>
#include <set>

#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

using ast::Statement;

constexpr std::size_t kLong = 300;  // statements of a body that is split, and
constexpr std::size_t kPart = 150;  // statements of each part

std::size_t count(const ast::Body& body);

std::size_t count(const Statement& one) {
  std::size_t all = 1 + count(one.body);
  for (const ast::Branch& branch : one.branches) {
    all += count(branch.body);
  }
  return all;
}

std::size_t count(const ast::Body& body) {
  std::size_t all = 0;
  for (const Statement& one : body) {
    all += count(one);
  }
  return all;
}

bool leaves(const Statement& one);

bool leaves(const ast::Body& body) {
  return std::any_of(body.begin(), body.end(), [](const Statement& one) { return leaves(one); });
}

bool leaves(const Statement& one) {
  const bool itself =
      one.kind == Statement::Kind::Return || one.kind == Statement::Kind::Jump || one.kind == Statement::Kind::Label;
  return itself || leaves(one.body) ||
         std::any_of(one.branches.begin(), one.branches.end(), [](const ast::Branch& arm) { return leaves(arm.body); });
}

// Returns true for the variables of drawn networks, whose address is never taken.
bool is_temporary(const Variable& variable) {
  return variable.section == ast::Section::Temp && variable.declared->made;
}

}  // namespace

BodyParts::BodyParts(const Pou& pou, bool divide) {
  const ast::Body& body = pou.tree->body;
  if (!divide || count(body) < kLong) {
    parts_.push_back({0, body.size(), false, {}});
    return;
  }
  split(body);
  find_locals(pou);
}

void BodyParts::split(const ast::Body& body) {
  std::size_t taken = 0;  // statements of the last part
  for (std::size_t i = 0; i < body.size(); ++i) {
    const bool alone = !leaves(body[i]);
    const bool network = body[i].kind == Statement::Kind::Empty;  // its power is used in no other network
    const bool full = taken >= kPart && (network || taken >= 2 * kPart);
    if (parts_.empty() || parts_.back().alone != alone || (alone && full)) {
      parts_.push_back({i, i, alone, {}});
      taken = 0;
    }
    taken += count(body[i]);
    parts_.back().end = i + 1;
  }
}

void BodyParts::find_locals(const Pou& pou) {
  std::set<const Variable*> shared;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto visit = [&](ast::Expression& one) {
      const Variable* variable = one.resolved ? one.resolved->variable : nullptr;
      if (variable == nullptr || !is_temporary(*variable)) {
        return;
      }
      const auto [home, first] = homes_.emplace(variable, i);
      if (home->second != i || !parts_[i].alone) {
        shared.insert(variable);
      }
    };
    for (std::size_t k = parts_[i].begin; k < parts_[i].end; ++k) {
      ast::each_expression(pou.tree->body[k], visit);
    }
  }
  for (const Variable* one : shared) {
    homes_.erase(one);
  }
  for (const Variable& one : pou.variables) {
    if (const auto home = homes_.find(&one); home != homes_.end()) {
      parts_[home->second].locals.push_back(&one);
    }
  }
}

}  // namespace indurop::plc
