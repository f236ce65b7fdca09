// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "control/plc/model/elementary.h"

namespace indurop::plc::network {
namespace {

using Kind = Element::Kind;

bool needs_input(Kind kind) noexcept {
  return kind == Kind::Contact || kind == Kind::Coil || kind == Kind::Jump || kind == Kind::Return ||
         kind == Kind::OutVariable || kind == Kind::Connector;
}
bool needs_text(Kind kind) noexcept {
  return kind == Kind::Contact || kind == Kind::Coil || kind == Kind::Jump || kind == Kind::Label ||
         kind == Kind::InVariable || kind == Kind::OutVariable || kind == Kind::InOutVariable ||
         kind == Kind::Connector || kind == Kind::Continuation;
}
bool has_output(Kind kind) noexcept {
  return kind == Kind::LeftRail || kind == Kind::Contact || kind == Kind::Coil || kind == Kind::Block ||
         kind == Kind::InVariable || kind == Kind::InOutVariable || kind == Kind::Continuation;
}
// Returns whether power flows out of it: several such elements at one pin are a parallel branch.
bool gives_power(Kind kind) noexcept {
  return kind == Kind::LeftRail || kind == Kind::Contact || kind == Kind::Coil || kind == Kind::Block;
}

std::string names_of(const std::vector<Pin>& pins) {
  std::vector<std::string> names;
  for (const Pin& pin : pins) {
    names.push_back(pin.name);
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

class Check {
 public:
  Check(const Index& index, Body::Language language, Diagnostics& diagnostics)
      : index_(index), language_(language), diagnostics_(diagnostics) {}

  void run(const Diagram& diagram, const std::vector<Network>& networks, const Order& order) {
    labels(diagram);
    for (const Network& network : networks) {
      for (const Element* element : network.elements) {
        check(*element);
      }
    }
    used(diagram);
    coils(diagram);
    for (const Element* element : order.circles) {
      diagnostics_.error(
          element->at,
          "its input depends on its own output in the same scan; put a variable or a function block into "
          "the loop");
    }
  }

 private:
  void labels(const Diagram& diagram) {
    for (const Element& element : diagram.elements) {
      if (element.kind == Kind::Label && !labels_.insert(upper(element.text)).second) {
        diagnostics_.error(element.at,
                           fmt::format("a second label '{}'; labels of a POU have different names", element.text));
      }
      if (element.kind == Kind::Connector && !connectors_.insert(upper(element.text)).second) {
        diagnostics_.error(
            element.at, fmt::format("a second connector '{}'; a continuation can go on from one only", element.text));
      }
    }
  }

  void check(const Element& element) {
    if (needs_text(element.kind) && (element.text.empty() || element.text.find("??") == 0)) {
      diagnostics_.error(element.at, fmt::format("this {} has no {}; write one", word_of(element.kind),
                                                 element.kind == Kind::InVariable ? "expression" : "name"));
    }
    if (element.kind == Kind::Jump && !element.text.empty() && !labels_.contains(upper(element.text))) {
      diagnostics_.error(element.at, fmt::format("there is no label '{}' in this POU", element.text));
    }
    if (element.kind == Kind::Continuation && index_.connector(element.text) == nullptr) {
      diagnostics_.error(element.at, fmt::format("there is no connector '{}' to continue from", element.text));
    }
    if (element.kind == Kind::Block) {
      block(element);
    } else if (needs_input(element.kind) && std::none_of(element.inputs.begin(), element.inputs.end(), connected)) {
      diagnostics_.error(element.at, "its left side is connected to nothing; draw a line to it, or remove it");
    }
    for (const auto* pins : {&element.inputs, &element.in_outs}) {
      for (const Pin& pin : *pins) {
        sources(pin);
      }
    }
  }

  static bool connected(const Pin& pin) noexcept { return !pin.connections.empty() || !pin.expression.empty(); }

  void block(const Element& element) {
    if (element.type.empty()) {
      diagnostics_.error(element.at, "this block has no type; write which function or function block it is");
    }
    for (const auto* pins : {&element.inputs, &element.outputs}) {
      std::unordered_set<std::string> names;
      for (const Pin& pin : *pins) {
        if (!pin.name.empty() && !names.insert(upper(pin.name)).second) {
          diagnostics_.error(pin.at, "a second pin of this name; remove one");
        }
      }
    }
    for (const Pin& pin : element.outputs) {
      if (pin.edge != ast::Edge::None || (pin.storage != Storage::None && pin.expression.empty())) {
        diagnostics_.error(pin.at,
                           "an edge, set or reset at an output of a box is not supported; draw a coil after it");
      }
    }
    for (const Pin& pin : element.inputs) {
      if (!connected(pin) && element.instance.empty() && !same_name(pin.name, "EN")) {  // an open EN is TRUE
        diagnostics_.error(pin.at, "this input of a function is connected to nothing; connect a value");
      }
    }
  }

  void sources(const Pin& pin) {
    bool parallel = language_ != Body::Language::Fbd;
    for (const Connection& connection : pin.connections) {
      const Source from = index_.source(connection);
      if (from.element == nullptr) {
        diagnostics_.error(connection.at, fmt::format("is connected to element {}, which does not exist; draw the line "
                                                      "again",
                                                      connection.from));
        continue;
      }
      if (!has_output(from.element->kind)) {
        diagnostics_.error(connection.at,
                           fmt::format("is connected to {}, which has no output", title_of(*from.element)));
      } else if (from.element->kind == Kind::Block && from.pin == nullptr) {
        diagnostics_.error(connection.at,
                           fmt::format("is connected to output '{}' of {}; its outputs: {}", connection.pin,
                                       title_of(*from.element), names_of(from.element->outputs)));
      }
      parallel = parallel && gives_power(from.element->kind);
    }
    if (pin.connections.size() + (pin.expression.empty() ? 0U : 1U) > 1 && !parallel) {
      diagnostics_.error(pin.at, fmt::format("{} values meet here; join them with a block (OR, for example)",
                                             pin.connections.size() + (pin.expression.empty() ? 0U : 1U)));
    }
  }

  // Warns of contacts that lead nowhere, and of unused values.
  void used(const Diagram& diagram) {
    std::unordered_set<const Element*> sources;
    for (const Element& element : diagram.elements) {
      for (const auto* pins : {&element.inputs, &element.in_outs}) {
        for (const Pin& pin : *pins) {
          for (const Connection& connection : pin.connections) {
            sources.insert(index_.find(connection.from));
          }
        }
      }
      if (element.condition && !element.condition->connections.empty()) {
        sources.insert(index_.find(element.condition->connections.front().from));
      }
    }
    for (const Element& element : diagram.elements) {
      if (element.kind == Kind::Contact && !sources.contains(&element)) {
        diagnostics_.error(element.at, "its right side is connected to nothing; draw a line to a coil, or remove it");
      } else if (element.kind == Kind::InVariable && !sources.contains(&element)) {
        diagnostics_.warning(element.at, "its value goes nowhere; remove it");
      }
    }
  }

  // Warns of two coils of a variable: the last one overwrites the first.
  void coils(const Diagram& diagram) {
    std::unordered_map<std::string, const Element*> known;
    for (const Element& element : diagram.elements) {
      if (element.kind != Kind::Coil || element.storage != Storage::None || element.edge != ast::Edge::None) {
        continue;
      }
      const auto [first, is_new] = known.emplace(upper(element.text), &element);
      if (!is_new && !element.text.empty()) {
        diagnostics_.warning(element.at,
                             fmt::format("'{}' has another coil already, of which nothing remains: join both "
                                         "rungs, or use set and reset coils",
                                         element.text));
      }
    }
  }

  const Index& index_;
  Body::Language language_;
  Diagnostics& diagnostics_;
  std::unordered_set<std::string> labels_;
  std::unordered_set<std::string> connectors_;
};

}  // namespace

void check_networks(const Diagram& diagram, const std::vector<Network>& networks, const Index& index,
                    const Order& order, Body::Language language, Diagnostics& diagnostics) {
  Check(index, language, diagnostics).run(diagram, networks, order);
}

}  // namespace indurop::plc::network
