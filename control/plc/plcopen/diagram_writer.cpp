// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/diagram_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "control/plc/plcopen/extensions.h"
#include "control/plc/plcopen/placement.h"

namespace indurop::plc::plcopen {
namespace {

using network::Body;
using network::Connection;
using network::Element;
using network::Pin;
using network::Point;
using network::Storage;
using Attributes = XmlWriter::Attributes;
using Kind = Element::Kind;

const char* tag_of(Kind kind) noexcept {
  switch (kind) {
    case Kind::LeftRail:
      return "leftPowerRail";
    case Kind::RightRail:
      return "rightPowerRail";
    case Kind::Contact:
      return "contact";
    case Kind::Coil:
      return "coil";
    case Kind::Block:
      return "block";
    case Kind::InVariable:
      return "inVariable";
    case Kind::OutVariable:
      return "outVariable";
    case Kind::InOutVariable:
      return "inOutVariable";
    case Kind::Label:
      return "label";
    case Kind::Jump:
      return "jump";
    case Kind::Return:
      return "return";
    case Kind::Connector:
      return "connector";
    case Kind::Continuation:
      return "continuation";
    case Kind::Comment:
      return "comment";
    case Kind::Title:
      return "vendorElement";
    case Kind::Step:
      return "step";
    case Kind::Transition:
      return "transition";
    case Kind::JumpStep:
      return "jumpStep";
    case Kind::SelectionDivergence:
      return "selectionDivergence";
    case Kind::SelectionConvergence:
      return "selectionConvergence";
    case Kind::SimultaneousDivergence:
      return "simultaneousDivergence";
    case Kind::SimultaneousConvergence:
      return "simultaneousConvergence";
    case Kind::ActionBlock:
      return "actionBlock";
  }
  return "";
}

// Returns the attribute with its name, or null.
const char* name_attribute(Kind kind) noexcept {
  switch (kind) {
    case Kind::Connector:
    case Kind::Continuation:
    case Kind::Step:
      return "name";
    case Kind::Label:
    case Kind::Jump:
      return "label";
    case Kind::JumpStep:
      return "targetName";
    default:
      return nullptr;
  }
}

bool has_output(Kind kind) noexcept {
  switch (kind) {
    case Kind::RightRail:
    case Kind::OutVariable:
    case Kind::Label:
    case Kind::Jump:
    case Kind::Return:
    case Kind::Connector:
    case Kind::Comment:
    case Kind::Title:
    case Kind::JumpStep:
    case Kind::ActionBlock:
      return false;
    default:
      return true;
  }
}

// Returns whether outputs of the element have names, possibly empty ones.
bool names_outputs(Kind kind) noexcept {
  return kind == Kind::LeftRail || kind == Kind::Step || kind == Kind::SelectionDivergence ||
         kind == Kind::SimultaneousDivergence;
}

bool is_variable(Kind kind) noexcept {
  return kind == Kind::InVariable || kind == Kind::OutVariable || kind == Kind::InOutVariable;
}

bool counts_in_order(Kind kind) noexcept {
  return kind == Kind::Block || kind == Kind::Contact || kind == Kind::Coil || is_variable(kind) ||
         kind == Kind::Jump || kind == Kind::Return || kind == Kind::Step || kind == Kind::Transition ||
         kind == Kind::ActionBlock;
}

void add_marks(Attributes& attributes, bool negated, ast::Edge edge, Storage storage) {
  if (negated) {
    attributes.emplace_back("negated", "true");
  }
  if (edge != ast::Edge::None) {
    attributes.emplace_back("edge", edge == ast::Edge::Rising ? "rising" : "falling");
  }
  if (storage != Storage::None) {
    attributes.emplace_back("storage", storage == Storage::Set ? "set" : "reset");
  }
}

class DiagramWriter {
 public:
  DiagramWriter(const std::vector<Element>& elements, XmlWriter& out) : elements_(elements), out_(out) {
    for (const Element& one : elements) {
      next_id_ = std::max(next_id_, one.id + 1);
      if (one.kind == Kind::ActionBlock && !one.inputs.empty()) {
        for (const Connection& line : one.inputs.front().connections) {
          acting_.insert(line.from);
        }
      }
    }
  }

  void run() {
    for (const Element& one : elements_) {
      element(one);
    }
  }

 private:
  void position(const char* name, const Point& at) {
    out_.leaf(name, {{"x", std::to_string(at.x)}, {"y", std::to_string(at.y)}});
  }

  Attributes attributes_of(const Element& one) {
    const std::uint64_t id = one.kind == Kind::Title ? next_id_++ : one.id;  // the ids of titles are not read
    Attributes out{
        {"localId", std::to_string(id)}, {"width", std::to_string(one.width)}, {"height", std::to_string(one.height)}};
    if (const char* name = name_attribute(one.kind)) {
      out.emplace_back(name, one.text);
    }
    if (one.order > 0 && counts_in_order(one.kind)) {
      out.emplace_back("executionOrderId", std::to_string(one.order));
    }
    if (one.kind == Kind::Block) {
      out.emplace_back("typeName", one.type);
      if (!one.instance.empty()) {
        out.emplace_back("instanceName", one.instance);
      }
    } else if (one.kind == Kind::InOutVariable) {
      if (one.negated) {
        out.emplace_back("negatedIn", "true");
      }
    } else if (is_variable(one.kind) || one.kind == Kind::Contact || one.kind == Kind::Coil) {
      add_marks(out, one.negated, one.edge, one.storage);
    }
    if (one.initial) {
      out.emplace_back("initialStep", "true");
    }
    if (one.priority > 0) {
      out.emplace_back("priority", std::to_string(one.priority));
    }
    return out;
  }

  void element(const Element& one) {
    out_.open(tag_of(one.kind), attributes_of(one));
    position("position", {one.x, one.y});
    switch (one.kind) {
      case Kind::Comment:
        out_.formatted("content", one.text);
        break;
      case Kind::Title:
        title(one);
        break;
      case Kind::Block:
        block(one);
        break;
      case Kind::ActionBlock:
        action_block(one);
        break;
      default:
        points(one);
    }
    out_.close();
  }

  // Writes a title in the form of CODESYS.
  void title(const Element& one) {
    out_.formatted("alternativeText", one.text);
    out_.open("addData");
    out_.open("data",
              {{"name", std::string(kExtensionsOfCodesys) + "fbdelementtype"}, {"handleUnknown", "implementation"}});
    out_.attribute_text("ElementType", "xmlns", "", "networktitle");
    out_.close();
    out_.close();
  }

  void points(const Element& one) {
    for (const Pin& pin : one.inputs) {
      point_in(pin);
    }
    for (std::size_t i = 0; has_output(one.kind) && i < std::max<std::size_t>(one.ends.size(), 1); ++i) {
      out_.open("connectionPointOut", names_outputs(one.kind) ? Attributes{{"formalParameter", ""}} : Attributes{});
      position("relPosition", i < one.ends.size() ? one.ends[i] : Point{one.width, one.height / 2});
      out_.close();
    }
    if (one.kind == Kind::Step) {
      step(one);
    } else if (one.kind == Kind::Transition) {
      condition(one);
    } else if (is_variable(one.kind) || one.kind == Kind::Contact || one.kind == Kind::Coil) {
      out_.text(is_variable(one.kind) ? "expression" : "variable", one.text);
    }
  }

  void step(const Element& one) {
    if (acting_.contains(one.id)) {
      out_.open("connectionPointOutAction", {{"formalParameter", ""}});
      position("relPosition", {one.width, one.height / 2});
      out_.close();
    }
    if (!one.actions.empty()) {
      out_.open("addData");
      out_.open("data",
                {{"name", std::string(kExtensionsOfCodesys) + "stepactions"}, {"handleUnknown", "implementation"}});
      out_.open("attributes", {{"xmlns", ""}});
      for (const network::ActionLine& line : one.actions) {
        out_.attribute_text("attribute", "guid", guid_of(line.qualifier), line.name);
      }
      out_.close();
      out_.close();
      out_.close();
    }
  }

  void condition(const Element& one) {
    if (!one.condition && one.inlined == nullptr && one.text.empty()) {
      return;
    }
    out_.open("condition");
    if (one.condition) {
      point_in(*one.condition);
    } else if (one.inlined != nullptr) {
      out_.open("inline", {{"name", ""}});
      write_body(*one.inlined, out_);
      out_.close();
    } else {
      out_.leaf("reference", {{"name", one.text}});
    }
    out_.close();
  }

  void point_in(const Pin& pin) {
    out_.open("connectionPointIn");
    if (pin.spot) {
      position("relPosition", *pin.spot);
    }
    lines(pin);
    out_.close();
  }

  void lines(const Pin& pin) {
    if (!pin.expression.empty()) {
      out_.text("expression", pin.expression);
      return;
    }
    for (const Connection& line : pin.connections) {
      Attributes attributes{{"refLocalId", std::to_string(line.from)}};
      if (!line.pin.empty()) {
        attributes.emplace_back("formalParameter", line.pin);
      }
      out_.open("connection", attributes);
      for (const Point& corner : line.corners) {
        position("position", corner);
      }
      out_.close();
    }
  }

  void block(const Element& one) {
    pins("inputVariables", one.inputs, true, false, one.width);
    pins("inOutVariables", one.in_outs, true, true, one.width);
    pins("outputVariables", one.outputs, false, true, one.width);
    if (one.inlined != nullptr) {
      out_.open("addData");
      out_.open("data", {{"name", std::string(kExtensionsOfCodesys) + "stcode"}, {"handleUnknown", "implementation"}});
      out_.attribute_text("STCode", "xmlns", "", one.inlined->text);
      out_.close();
      out_.close();
    }
  }

  void pins(const char* list, const std::vector<Pin>& all, bool in, bool leaves, int width) {
    out_.open(list);
    for (const Pin& pin : all) {
      Attributes attributes{{"formalParameter", pin.name}};
      add_marks(attributes, pin.negated, pin.edge, pin.storage);
      out_.open("variable", attributes);
      if (in) {
        point_in(pin);
      }
      if (leaves) {
        out_.open("connectionPointOut");
        position("relPosition", {width, pin.spot ? pin.spot->y : 0});
        if (!in && !pin.expression.empty()) {
          out_.text("expression", pin.expression);
        }
        out_.close();
      }
      out_.close();
    }
    out_.close();
  }

  void action_block(const Element& one) {
    for (const Pin& pin : one.inputs) {
      point_in(pin);
    }
    int y = 0;
    for (const network::ActionLine& line : one.actions) {
      Attributes attributes{{"localId", std::to_string(next_id_++)}, {"qualifier", line.qualifier}};
      if (!line.duration.empty()) {
        attributes.emplace_back("duration", line.duration);
      }
      if (!line.indicator.empty()) {
        attributes.emplace_back("indicator", line.indicator);
      }
      out_.open("action", attributes);
      position("relPosition", {0, y});
      if (line.inlined != nullptr) {
        out_.open("inline");
        write_body(*line.inlined, out_);
        out_.close();
      } else {
        out_.leaf("reference", {{"name", line.name}});
      }
      out_.close();
      y += 30;
    }
  }

  const std::vector<Element>& elements_;
  std::unordered_set<std::uint64_t> acting_;  // steps with an action block
  XmlWriter& out_;
  std::uint64_t next_id_ = 1;
};

}  // namespace

void write_body(const Body& body, XmlWriter& out) {
  switch (body.language) {
    case Body::Language::None:
    case Body::Language::St:
      out.formatted("ST", body.text);
      return;
    case Body::Language::Il:
      out.formatted("IL", body.text);
      return;
    case Body::Language::Ld:
    case Body::Language::Fbd:
    case Body::Language::Sfc:
      break;
  }
  Body placed = body;
  place(placed);
  out.open(body.language == Body::Language::Ld ? "LD" : body.language == Body::Language::Fbd ? "FBD" : "SFC");
  DiagramWriter(placed.diagram.elements, out).run();
  out.close();
}

}  // namespace indurop::plc::plcopen
