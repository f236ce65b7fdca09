// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/networks.h"

#include <fmt/format.h>

#include <unordered_map>

#include "control/plc/lower/blocks.h"
#include "control/plc/lower/network_code.h"
#include "control/plc/model/make.h"

namespace indurop::plc::lower {
namespace {

using Kind = Element::Kind;

class NetworkLowering {
 public:
  NetworkLowering(const Sheet& sheet, const NetworkOptions& options, Diagnostics& diagnostics)
      : sheet_(sheet), code_(sheet, options, diagnostics), blocks_(code_, options) {}

  LoweredNetworks run() {
    std::unordered_map<const Element*, const Network*> networks;
    for (const Network& network : sheet_.networks) {
      for (const Element* element : network.elements) {
        networks.emplace(element, &network);
      }
    }
    const Network* current = nullptr;
    for (const Element* element : sheet_.order.elements) {
      const auto network = networks.find(element);
      if (network == networks.end()) {
        continue;
      }
      if (network->second != current && begun_.insert(network->second).second) {
        begin(*network->second, element->at);
      }
      current = network->second;
      evaluate(*element);
    }
    for (const Network& network : sheet_.networks) {
      if (begun_.insert(&network).second) {
        begin(network, {});  // labels after the last network
      }
    }
    return code_.finish();
  }

 private:
  void begin(const Network& network, const Place& at) {
    code_.end_network();
    for (const std::string& label : network.labels) {
      code_.add(make::label(at, label));
    }
    std::string text = network.title.empty() && !network.comments.empty() ? network.comments.front() : network.title;
    text = text.substr(0, text.find('\n'));
    ast::Statement remark;
    remark.at = at;
    remark.comment = fmt::format("network {}{}{}", network.number, text.empty() ? "" : ": ", text);
    code_.add(std::move(remark));
  }

  void evaluate(const Element& element) {
    switch (element.kind) {
      case Kind::Contact:
        contact(element);
        break;
      case Kind::Coil:
        coil(element);
        break;
      case Kind::Block:
        blocks_.block(element);
        break;
      case Kind::OutVariable:
      case Kind::InOutVariable:
        variable(element);
        break;
      case Kind::Jump:
      case Kind::Return:
        code_.add(make::leave(element.at, element.kind == Kind::Jump ? element.text : std::string(),
                              code_.input(element, element.inputs.front())));
        break;
      default:
        break;  // values and connectors are read where they are used
    }
  }

  void contact(const Element& element) {
    auto variable = code_.parse(element.text, element.at);
    if (!variable) {
      return;
    }
    variable->as_truth = true;
    if (element.edge != ast::Edge::None) {
      variable = code_.edge(std::move(*variable), element.edge, key_of(element));
    } else if (element.negated) {
      variable = make::negation(std::move(*variable));
    }
    ast::Expression before = code_.input(element, element.inputs.front());
    const bool always = make::is_true(before);  // at the rail: only the contact decides
    const ast::Expression closed = *variable;
    const ast::Expression power = code_.power(element, make::both(std::move(before), std::move(*variable)));
    code_.show(FlowPoint::Kind::Closed, {&element, nullptr}, always ? power : closed);
    code_.define(element, nullptr, power);
  }

  void coil(const Element& element) {
    auto target = code_.parse(element.text, element.at);
    if (!target) {
      return;
    }
    target->as_truth = true;
    const ast::Expression power = code_.power(element, code_.input(element, element.inputs.front()));
    code_.define(element, nullptr, power);
    ast::Expression value = power;
    if (element.edge != ast::Edge::None) {
      value = code_.edge(std::move(value), element.edge, key_of(element));
    }
    code_.store(std::move(*target), {std::move(value), {}}, element.storage, element.negated);
  }

  void variable(const Element& element) {
    if (element.inputs.empty() || element.inputs.front().connections.empty()) {
      return;
    }
    if (auto target = code_.parse(element.text, element.at)) {
      code_.store(std::move(*target), code_.input_value(element, element.inputs.front()), element.storage,
                  element.negated);
    }
  }

  const Sheet& sheet_;
  NetworkCode code_;
  BlockLowering blocks_;
  std::unordered_set<const Network*> begun_;
};

}  // namespace

LoweredNetworks lower_networks(const Sheet& sheet, const NetworkOptions& options, Diagnostics& diagnostics) {
  if (sheet.order.circles.empty()) {
    return NetworkLowering(sheet, options, diagnostics).run();
  }
  LoweredNetworks nothing;  // the error was reported; a circle of connectors has no end
  for (const WantedPin& each : options.wanted) {
    nothing.wanted.push_back(make::truth(each.element->at, false));
  }
  return nothing;
}

}  // namespace indurop::plc::lower
