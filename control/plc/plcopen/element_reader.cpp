// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/element_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/extensions.h"
#include "core/base/text.h"

namespace indurop::plc::plcopen {
namespace {

using base::trimmed;
using network::Element;
using network::Pin;
using network::Storage;
using Kind = Element::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 22> kKinds{
    {{"leftPowerRail", Kind::LeftRail},
     {"rightPowerRail", Kind::RightRail},
     {"contact", Kind::Contact},
     {"coil", Kind::Coil},
     {"block", Kind::Block},
     {"inVariable", Kind::InVariable},
     {"outVariable", Kind::OutVariable},
     {"inOutVariable", Kind::InOutVariable},
     {"label", Kind::Label},
     {"jump", Kind::Jump},
     {"return", Kind::Return},
     {"connector", Kind::Connector},
     {"continuation", Kind::Continuation},
     {"comment", Kind::Comment},
     {"step", Kind::Step},
     {"transition", Kind::Transition},
     {"jumpStep", Kind::JumpStep},
     {"selectionDivergence", Kind::SelectionDivergence},
     {"selectionConvergence", Kind::SelectionConvergence},
     {"simultaneousDivergence", Kind::SimultaneousDivergence},
     {"simultaneousConvergence", Kind::SimultaneousConvergence},
     {"actionBlock", Kind::ActionBlock}}};

// Attributes and elements that contain the names of elements.
constexpr std::array<std::string_view, 4> kNameAttributes{"name", "label", "targetName", "target"};
constexpr std::array<std::string_view, 2> kNameElements{"variable", "expression"};

bool has_one_input(Kind kind) noexcept {
  return kind == Kind::Contact || kind == Kind::Coil || kind == Kind::Jump || kind == Kind::Return ||
         kind == Kind::OutVariable || kind == Kind::Connector;
}

// Returns a coordinate on the sheet; 0 for invalid text, because positions only affect order and drawing.
int coordinate(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double kFar = 1e8;
  return error == std::errc{} && end != text.data() && std::abs(value) < kFar ? static_cast<int>(std::lround(value))
                                                                              : 0;
}

network::Point point_of(const Node& position) {
  return {coordinate(position.attribute("x")), coordinate(position.attribute("y"))};
}

class ElementReader {
 public:
  ElementReader(std::string what, Diagnostics& diagnostics)
      : what_(std::make_shared<const std::string>(std::move(what))), diagnostics_(diagnostics) {}

  network::Diagram read(const Node& language) {
    for (const Node& node : language.children) {
      if (node.name == "vendorElement") {
        title(node);
      } else if (node.name == "error") {
        diagnostics_.error(place(node),
                           fmt::format("the editor saved an error here: {}", trimmed(formatted_text(node))));
      } else if (node.name == "macroStep") {
        diagnostics_.error(place(node), "macro steps are not supported; draw their steps in place");
      } else if (node.name != "addData" && node.name != "documentation") {
        element(node);
      }
    }
    name_conditions();
    return std::move(diagram_);
  }

 private:
  // Sets the text printed at a transition that has one operand drawn to it.
  void name_conditions() {
    for (Element& each : diagram_.elements) {
      if (each.condition && each.condition->connections.size() == 1) {
        const Element* from = diagram_.find(each.condition->connections[0].from);
        each.text = from != nullptr && from->kind == Kind::InVariable ? from->text : each.text;
      }
    }
  }

  [[nodiscard]] Place place(const Node& node) const {
    Place at = node.at;
    at.within = what_;
    return at;
  }

  // Reads titles of networks; other elements of vendors are ignored.
  void title(const Node& node) {
    const Node* text = node.child("alternativeText");
    const Node* extension = node.child("addData");
    if (text != nullptr && extension != nullptr &&
        formatted_text(*extension).find("networktitle") != std::string::npos) {
      Element& made = diagram_.elements.emplace_back();
      made.kind = Kind::Title;
      made.at = place(node);
      if (const Node* position = node.child("position")) {
        made.x = point_of(*position).x;
        made.y = point_of(*position).y;
      }
      made.text = trimmed(formatted_text(*text));
    }
  }

  void element(const Node& node) {
    const auto* known =
        std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& kind) { return kind.first == node.name; });
    if (known == kKinds.end()) {
      diagnostics_.error(place(node), fmt::format("<{}> is not an element of LD, FBD or SFC; remove it", node.name));
      return;
    }
    Element made;
    made.kind = known->second;
    made.at = place(node);
    if (!identify(node, made)) {
      return;
    }
    common(node, made);
    if (made.kind == Kind::Block) {
      block(node, made);
    } else if (made.kind == Kind::Transition) {
      transition(node, made);
    } else if (made.kind == Kind::ActionBlock) {
      action_block(node, made);
    } else if (made.kind == Kind::Step) {
      step_actions(node, made);
    }
    diagram_.elements.push_back(std::move(made));
  }

  bool identify(const Node& node, Element& made) {
    const auto id = number(node, "localId");
    if (!id) {
      return false;
    }
    made.id = *id;
    const auto [other, fresh] = lines_.try_emplace(*id, node.at.line);
    if (!fresh) {
      diagnostics_.error(made.at, fmt::format("localId {} is already taken in line {}; each element of a body has its "
                                              "own number",
                                              *id, other->second));
    }
    return fresh;
  }

  std::optional<std::uint64_t> number(const Node& node, std::string_view attribute) {
    const std::string_view text = node.attribute(attribute);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size() && !text.empty()) {
      return value;
    }
    diagnostics_.error(place(node), text.empty()
                                        ? fmt::format("<{}> lacks its {}", node.name, attribute)
                                        : fmt::format("{}=\"{}\" of <{}> is not a number", attribute, text, node.name));
    return std::nullopt;
  }

  void common(const Node& node, Element& made) {
    if (const Node* position = node.child("position")) {
      made.x = coordinate(position->attribute("x"));
      made.y = coordinate(position->attribute("y"));
    }
    made.width = coordinate(node.attribute("width"));
    made.height = coordinate(node.attribute("height"));
    made.order = coordinate(node.attribute("executionOrderId"));
    made.negated = node.is_true("negated") || node.is_true("negatedIn");
    made.edge = edge(node);
    made.storage = storage(node);
    made.initial = node.is_true("initialStep");
    made.priority = coordinate(node.attribute("priority"));
    for (const std::string_view attribute : kNameAttributes) {
      if (node.has(attribute)) {
        made.text = trimmed(node.attribute(attribute));
      }
    }
    for (const std::string_view name : kNameElements) {
      if (const Node* child = node.child(name)) {
        made.text = trimmed(formatted_text(*child));
      }
    }
    if (const Node* content = node.child("content")) {
      made.text = trimmed(formatted_text(*content));
    }
    for (const Node& child : node.children) {
      if (child.name == "connectionPointIn") {
        Pin& pin = made.inputs.emplace_back();
        pin.at = place(child);
        connect(child, pin);
      } else if (const Node* end = child.name == "connectionPointOut" ? child.child("relPosition") : nullptr) {
        made.ends.push_back(point_of(*end));
      }
    }
    if (made.inputs.empty() && has_one_input(made.kind)) {
      made.inputs.emplace_back().at = made.at;  // not connected: an error of the drawing
    }
    if (made.kind == Kind::InOutVariable && node.is_true("negatedOut")) {
      diagnostics_.error(made.at, "a negated output of a variable is not supported; negate the pins after it");
    }
  }

  void connect(const Node& point, Pin& pin) {
    for (const Node& child : point.children) {
      if (child.name == "connection") {
        if (const auto from = number(child, "refLocalId")) {
          pin.connections.push_back({place(child), *from, std::string(child.attribute("formalParameter")), {}});
          for (const Node& corner : child.children) {
            if (corner.name == "position") {
              pin.connections.back().corners.push_back(point_of(corner));
            }
          }
        }
      } else if (child.name == "relPosition") {
        pin.spot = point_of(child);
      } else if (child.name == "expression") {
        pin.expression = trimmed(formatted_text(child));
      }
    }
  }

  ast::Edge edge(const Node& node) {
    const std::string_view text = node.attribute("edge");
    if (!text.empty() && text != "none" && text != "rising" && text != "falling") {
      diagnostics_.error(place(node), fmt::format("edge=\"{}\" is none of none, rising, falling", text));
    }
    return text == "rising" ? ast::Edge::Rising : text == "falling" ? ast::Edge::Falling : ast::Edge::None;
  }

  Storage storage(const Node& node) {
    const std::string_view text = node.attribute("storage");
    if (!text.empty() && text != "none" && text != "set" && text != "reset") {
      diagnostics_.error(place(node), fmt::format("storage=\"{}\" is none of none, set, reset", text));
    }
    return text == "set" ? Storage::Set : text == "reset" ? Storage::Reset : Storage::None;
  }

  void block(const Node& node, Element& made) {
    made.type = trimmed(node.attribute("typeName"));
    made.instance = trimmed(node.attribute("instanceName"));
    made.text.clear();
    if (const Node* pins = node.child("inputVariables")) {
      read_pins(*pins, made.inputs);
    }
    if (const Node* pins = node.child("inOutVariables")) {
      read_pins(*pins, made.in_outs);
    }
    if (const Node* pins = node.child("outputVariables")) {
      read_pins(*pins, made.outputs);
    }
    for (const Node& data : children_of(node.child("addData"))) {
      if (const Node* code = data.child("STCode")) {  // CODESYS' box EXECUTE
        made.inlined = std::make_shared<network::Body>();
        made.inlined->language = network::Body::Language::St;
        made.inlined->at = place(*code);
        made.inlined->text = formatted_text(*code, &made.inlined->text_at);
        made.inlined->text_at.within = what_;
      }
    }
  }

  void read_pins(const Node& list, std::vector<Pin>& pins) {
    for (const Node& node : list.children) {
      if (node.name != "variable") {
        continue;
      }
      Pin& pin = pins.emplace_back();
      pin.at = place(node);
      pin.name = trimmed(node.attribute("formalParameter"));
      pin.negated = node.is_true("negated");
      pin.edge = edge(node);
      pin.storage = storage(node);
      for (const char* point : {"connectionPointIn", "connectionPointOut"}) {
        if (const Node* child = node.child(point)) {
          connect(*child, pin);
        }
      }
    }
  }

  void transition(const Node& node, Element& made) {
    const Node* condition = node.child("condition");
    if (condition == nullptr) {
      return;
    }
    if (condition->is_true("negated")) {
      diagnostics_.error(place(*condition), "a negated condition is not supported; write NOT into it");
    }
    if (const Node* reference = condition->child("reference")) {
      made.text = trimmed(reference->attribute("name"));
    } else if (const Node* inlined = condition->child("inline")) {
      made.inlined = std::make_shared<network::Body>(
          read_body(*inlined, fmt::format("{}, transition {}", *what_, made.id), diagnostics_));
    } else {
      const Node* point = condition->child("connectionPointIn");
      Pin& pin = made.condition.emplace();
      pin.at = place(*condition);
      connect(point != nullptr ? *point : *condition, pin);
    }
  }

  // Reads the actions of a step itself, which CODESYS and TwinCAT store in attributes with numbers as names.
  void step_actions(const Node& node, Element& made) {
    for (const Node& data : children_of(node.child("addData"))) {
      for (const Node& attribute : children_of(data.child("attributes"))) {
        const auto* known = std::find_if(kStepActions.begin(), kStepActions.end(),
                                         [&](const auto& each) { return each.first == attribute.attribute("guid"); });
        if (known != kStepActions.end() && !trimmed(attribute.text).empty()) {
          network::ActionLine& line = made.actions.emplace_back();
          line.at = place(attribute);
          line.qualifier = known->second;
          line.name = trimmed(attribute.text);
          line.only_action = true;
        }
      }
    }
  }

  void action_block(const Node& node, Element& made) {
    for (const Node& child : node.children) {
      if (child.name != "action") {
        continue;
      }
      network::ActionLine& line = made.actions.emplace_back();
      line.at = place(child);
      line.duration = trimmed(child.attribute("duration"));
      line.indicator = trimmed(child.attribute("indicator"));
      if (child.has("qualifier") && !trimmed(child.attribute("qualifier")).empty()) {
        line.qualifier = trimmed(child.attribute("qualifier"));
      }
      if (const Node* reference = child.child("reference")) {
        line.name = trimmed(reference->attribute("name"));
      } else if (const Node* inlined = child.child("inline")) {
        line.inlined = std::make_shared<network::Body>(read_body(
            *inlined, fmt::format("{}, action {} of block {}", *what_, made.actions.size(), made.id), diagnostics_));
      }
    }
  }

  std::shared_ptr<const std::string> what_;
  Diagnostics& diagnostics_;
  network::Diagram diagram_;
  std::unordered_map<std::uint64_t, int> lines_;  // of ids
};

}  // namespace

network::Diagram read_elements(const Node& language, const std::string& what, Diagnostics& diagnostics) {
  return ElementReader(what, diagnostics).read(language);
}

}  // namespace indurop::plc::plcopen
