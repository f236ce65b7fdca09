// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/live.h"

#include <algorithm>

#include "control/plc/lower/flow.h"

namespace indurop::plc {
namespace {

using Language = network::Body::Language;
using PointKind = lower::FlowPoint::Kind;

void number_points(lower::LoweredNetworks lowered, LiveBody& body) {
  const std::size_t points = lower::number_points(lowered.flow);
  for (const lower::FlowPoint& point : lowered.flow) {
    if (point.kind == PointKind::Power) {
      body.power.emplace(LiveBody::Key(point.source.element, point.source.pin), point.number);
    } else if (point.kind == PointKind::Closed) {
      body.closed.emplace(point.source.element, point.number);
    }
  }
  body.flow_variable = points == 0 ? std::string() : lower::flow_variable(body.action);
}

class LiveReader {
 public:
  LiveReader(const Project& project, Diagnostics& diagnostics) : project_(project), diagnostics_(diagnostics) {}

  void add(const std::string& pou, const std::string& action, network::Body& body) {
    LiveBody made;
    made.pou = pou;
    made.action = action;
    made.body = &body;
    const std::string what = "POU " + pou + (action.empty() ? "" : ", action " + action);
    if (body.language == Language::Ld || body.language == Language::Fbd) {
      draw(what, made);
    } else if (body.language == Language::Sfc) {
      made.sheet = network::make_sheet(body, what, diagnostics_);
      made.chart = network::read_chart(body.diagram, diagnostics_);
    }
    bodies_.push_back(std::move(made));
  }

  std::vector<LiveBody> take() { return std::move(bodies_); }

 private:
  void draw(const std::string& what, LiveBody& made) {
    made.sheet = network::make_sheet(*made.body, what, diagnostics_);
    if (diagnostics_.failed()) {
      return;
    }
    lower::NetworkOptions options;
    options.project = &project_;
    options.flow = true;
    number_points(lower::lower_networks(*made.sheet, options, diagnostics_), made);
    made.pictures = draw::lay_out(*made.sheet, *made.body, diagnostics_);
  }

  const Project& project_;
  Diagnostics& diagnostics_;
  std::vector<LiveBody> bodies_;
};

}  // namespace

bool LivePower::powered(const network::Source& source) {
  return known(source).value_or(false);
}

std::optional<bool> LivePower::known(const network::Source& source) {
  const network::Element& element = *source.element;
  if (element.kind == network::Element::Kind::LeftRail) {
    return true;
  }
  if (const auto point = body_.power.find({source.element, source.pin}); point != body_.power.end()) {
    return power_(point->second);
  }
  if (const auto done = derived_.find(&element); done != derived_.end()) {
    return done->second;
  }
  derived_[&element] = std::nullopt;  // a line that leads back brings nothing
  return derived_[&element] = derived(source);
}

std::optional<bool> LivePower::derived(const network::Source& source) {
  using Kind = network::Element::Kind;
  const network::Element& element = *source.element;
  const auto with_sign = [](std::optional<bool> value, bool negated) { return value ? *value != negated : value; };
  switch (element.kind) {
    case Kind::Contact:
    case Kind::Coil: {
      if (element.inputs.empty() || (element.kind == Kind::Contact && !closed(element))) {
        return false;
      }
      const auto& lines = element.inputs.front().connections;
      return std::any_of(lines.begin(), lines.end(), [&](const network::Connection& line) {
        const network::Source before = body_.sheet->index.source(line);
        return before.element != nullptr && powered(before);
      });
    }
    case Kind::InVariable:
    case Kind::InOutVariable:
      return with_sign(of_variable(element.text), element.negated);
    case Kind::Block:
      return with_sign(of_logic(element), source.pin != nullptr && source.pin->negated);
    default:
      return std::nullopt;
  }
}

std::optional<bool> LivePower::of_variable(const std::string& text) const {
  const std::string name = upper(text);
  const std::string value = name == "TRUE" || name == "FALSE" ? name : value_(name);
  return value == "TRUE" ? std::optional(true) : value == "FALSE" ? std::optional(false) : std::nullopt;
}

std::optional<bool> LivePower::before(const network::Pin& pin) {
  if (pin.connections.empty()) {
    return of_variable(pin.expression);
  }
  const network::Source source = body_.sheet->index.source(pin.connections.front());
  const bool plain = pin.connections.size() == 1 && pin.edge == ast::Edge::None && source.element != nullptr;
  return plain ? known(source) : std::nullopt;
}

// Determines the power of functions whose module does not report whether they are of BOOL from their inputs.
std::optional<bool> LivePower::of_logic(const network::Element& element) {
  const std::string type = upper(element.type);
  const bool logic = type == "AND" || type == "OR" || type == "XOR" || type == "NOT" || type == "MOVE";
  if (!logic || !element.instance.empty() || element.inputs.empty()) {
    return std::nullopt;
  }
  std::optional<bool> all;
  for (const network::Pin& pin : element.inputs) {
    const auto value = same_name(pin.name, "EN") ? std::nullopt : before(pin);
    if (!value) {
      return std::nullopt;  // with EN off it keeps its previous output
    }
    const bool on = *value != pin.negated;
    if (!all) {
      all = on;
    } else if (type == "AND") {
      all = *all && on;
    } else {
      all = type == "OR" ? *all || on : *all != on;
    }
  }
  return type == "NOT" ? !*all : *all;
}

bool LivePower::closed(const network::Element& element) {
  const auto point = body_.closed.find(&element);
  return point != body_.closed.end() ? power_(point->second) : powered({&element, nullptr});
}

std::vector<LiveBody> live_bodies(plcopen::Document& document, const std::string& pou, Diagnostics& diagnostics) {
  Project declared;
  for (const plcopen::PouDocument& each : document.pous) {
    declared.pous.push_back(each.pou);
  }
  LiveReader reader(declared, diagnostics);
  for (plcopen::PouDocument& each : document.pous) {
    const bool keeps = each.pou.kind == ast::Pou::Kind::Program || each.pou.kind == ast::Pou::Kind::FunctionBlock;
    if (!keeps || (!pou.empty() && !same_name(pou, each.pou.name))) {
      continue;
    }
    reader.add(each.pou.name, "", each.code.body);
    for (network::NamedBody& action : each.code.actions) {
      reader.add(each.pou.name, action.name, action.body);
    }
  }
  return reader.take();
}

}  // namespace indurop::plc
