// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/diagram.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::plc::network {

const char* word_of(Element::Kind kind) noexcept {
  switch (kind) {
    case Element::Kind::LeftRail:
      return "left power rail";
    case Element::Kind::RightRail:
      return "right power rail";
    case Element::Kind::Contact:
      return "contact";
    case Element::Kind::Coil:
      return "coil";
    case Element::Kind::Block:
      return "block";
    case Element::Kind::InVariable:
      return "input variable";
    case Element::Kind::OutVariable:
      return "output variable";
    case Element::Kind::InOutVariable:
      return "variable";
    case Element::Kind::Label:
      return "label";
    case Element::Kind::Jump:
      return "jump";
    case Element::Kind::Return:
      return "return";
    case Element::Kind::Connector:
      return "connector";
    case Element::Kind::Continuation:
      return "continuation";
    case Element::Kind::Comment:
      return "comment";
    case Element::Kind::Title:
      return "title";
    case Element::Kind::Step:
      return "step";
    case Element::Kind::Transition:
      return "transition";
    case Element::Kind::JumpStep:
      return "jump to step";
    case Element::Kind::SelectionDivergence:
      return "selection divergence";
    case Element::Kind::SelectionConvergence:
      return "selection convergence";
    case Element::Kind::SimultaneousDivergence:
      return "simultaneous divergence";
    case Element::Kind::SimultaneousConvergence:
      return "simultaneous convergence";
    case Element::Kind::ActionBlock:
      return "action block";
  }
  return "";
}

std::string title_of(const Element& element) {
  std::string name = element.text;
  if (element.kind == Element::Kind::Block) {
    name = element.instance.empty() ? element.type : element.instance;
  }
  return fmt::format("{} {}", word_of(element.kind), name.empty() ? std::to_string(element.id) : name);
}

const Element* Diagram::find(std::uint64_t id) const noexcept {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const Element& element) { return element.id == id; });
  return found == elements.end() ? nullptr : &*found;
}

}  // namespace indurop::plc::network
