// SPDX-License-Identifier: Apache-2.0
#include "plc/print/live.h"

#include <algorithm>

#include "plc/lower/flow.h"

namespace indurop::plc {
namespace {

using Language = network::Body::Language;
using Kind = lower::FlowPoint::Kind;

void number_points(lower::LoweredNetworks lowered, LiveBody& body) {
  const std::size_t points = lower::number_points(lowered.flow);
  for (const lower::FlowPoint& point : lowered.flow) {
    if (point.kind == Kind::Power) {
      body.power.emplace(LiveBody::Key(point.source.element, point.source.pin), point.number);
    } else if (point.kind == Kind::Closed) {
      body.closed.emplace(point.source.element, point.number);
    }
  }
  body.flow_variable = points == 0 ? std::string() : lower::flow_variable(body.action);
}

class Reader {
 public:
  Reader(const Project& project, Diagnostics& diagnostics) : project_(project), diagnostics_(diagnostics) {}

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
    made.pictures = draw::lay_out(*made.sheet, made.body->language);
  }

  const Project& project_;
  Diagnostics& diagnostics_;
  std::vector<LiveBody> bodies_;
};

}  // namespace

bool LivePower::powered(const network::Source& source) {
  const network::Element& element = *source.element;
  if (element.kind == network::Element::Kind::LeftRail) {
    return true;
  }
  if (const auto point = body_.power.find({source.element, source.pin}); point != body_.power.end()) {
    return told_(point->second);
  }
  const bool contact = element.kind == network::Element::Kind::Contact;
  if ((!contact && element.kind != network::Element::Kind::Coil) || element.inputs.empty()) {
    return false;
  }
  if (const auto known = derived_.find(&element); known != derived_.end()) {
    return known->second;
  }
  derived_[&element] = false;  // a line that leads back brings nothing
  const auto& lines = element.inputs.front().connections;
  const bool on =
      (!contact || closed(element)) && std::any_of(lines.begin(), lines.end(), [&](const network::Connection& line) {
        const network::Source before = body_.sheet->index.source(line);
        return before.element != nullptr && powered(before);
      });
  derived_[&element] = on;
  return on;
}

bool LivePower::closed(const network::Element& element) {
  const auto point = body_.closed.find(&element);
  return point != body_.closed.end() ? told_(point->second) : powered({&element, nullptr});
}

std::vector<LiveBody> live_bodies(plcopen::Document& document, const std::string& pou, Diagnostics& diagnostics) {
  Project declared;
  for (const plcopen::PouDocument& each : document.pous) {
    declared.pous.push_back(each.pou);
  }
  Reader reader(declared, diagnostics);
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
