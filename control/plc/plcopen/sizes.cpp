// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/sizes.h"

#include <algorithm>

#include "control/plc/draw/shape.h"

namespace indurop::plc::plcopen {
namespace {

using network::Element;
using network::Pin;
using network::Point;
using Kind = Element::Kind;

constexpr int kHead = 30;  // height of a block above its first pin

int text_size(const Element& element) {
  return kCharacter * std::max(1, draw::text_width(element.text));
}

int pins_of(const Element& block) {
  const std::size_t most = std::max(block.inputs.size(), block.outputs.size()) + block.in_outs.size();
  return static_cast<int>(std::max<std::size_t>(most, 1));
}

Point size_of(const Element& element) {
  const int text = text_size(element);
  const int lines = 1 + static_cast<int>(std::count(element.text.begin(), element.text.end(), '\n'));
  switch (element.kind) {
    case Kind::LeftRail:
    case Kind::RightRail:
      return {3, 2 * kLine};
    case Kind::Contact:
    case Kind::Coil:
      return {21, 15};
    case Kind::Block:
      return {kCharacter * draw::shape_of(element).width, kHead + kLine * pins_of(element)};
    case Kind::Comment:
    case Kind::Title:
      return {std::min(text, 40 * kCharacter), kLine * (lines + text / (40 * kCharacter))};
    case Kind::Return:
      return {5 * kCharacter, kLine};
    case Kind::Step:
      return {text + 2 * kCharacter, 30};
    case Kind::Transition:
      return {20, 2};
    case Kind::JumpStep:
      return {12, 13};
    case Kind::SelectionDivergence:
    case Kind::SelectionConvergence:
      return {20, 1};
    case Kind::SimultaneousDivergence:
    case Kind::SimultaneousConvergence:
      return {20, 3};
    case Kind::ActionBlock:
      return {10 * kCharacter, 30 * static_cast<int>(std::max<std::size_t>(element.actions.size(), 1))};
    case Kind::InVariable:
    case Kind::OutVariable:
    case Kind::InOutVariable:
    case Kind::Label:
    case Kind::Jump:
    case Kind::Connector:
    case Kind::Continuation:
      break;
  }
  return {text + 2 * kCharacter, kLine};
}

// Returns the position of the k-th of several lines along a side.
int along(int length, std::size_t k, std::size_t count) {
  return static_cast<int>((2 * k + 1) * static_cast<std::size_t>(length) / (2 * std::max<std::size_t>(count, 1)));
}

void pins_of_block(std::vector<Pin>& pins, int x, std::size_t first) {
  for (std::size_t i = 0; i < pins.size(); ++i) {
    if (!pins[i].spot) {
      pins[i].spot = Point{x, kHead + kLine * static_cast<int>(first + i)};
    }
  }
}

}  // namespace

bool is_upright(Kind kind) noexcept {
  switch (kind) {
    case Kind::Step:
    case Kind::Transition:
    case Kind::JumpStep:
    case Kind::SelectionDivergence:
    case Kind::SelectionConvergence:
    case Kind::SimultaneousDivergence:
    case Kind::SimultaneousConvergence:
      return true;
    default:
      return false;
  }
}

void give_size(Element& element) {
  const Point size = size_of(element);
  element.width = element.width > 0 ? element.width : size.x;
  element.height = element.height > 0 ? element.height : size.y;
}

void give_spots(Element& element, std::size_t ends) {
  if (element.kind == Kind::Block) {
    pins_of_block(element.inputs, 0, 0);
    pins_of_block(element.in_outs, 0, element.inputs.size());
    pins_of_block(element.outputs, element.width, 0);
    return;
  }
  const bool upright = is_upright(element.kind);
  for (std::size_t i = 0; i < element.inputs.size(); ++i) {
    if (!element.inputs[i].spot) {
      element.inputs[i].spot =
          upright ? Point{along(element.width, i, element.inputs.size()), 0}
                  : Point{0, element.kind == Kind::ActionBlock ? 15 : along(element.height, i, element.inputs.size())};
    }
  }
  if (element.condition && !element.condition->spot) {
    element.condition->spot = Point{0, element.height / 2};
  }
  for (std::size_t i = element.ends.size(); i < ends; ++i) {
    element.ends.push_back(upright ? Point{along(element.width, i, ends), element.height}
                                   : Point{element.width, along(element.height, i, ends)});
  }
}

}  // namespace indurop::plc::plcopen
