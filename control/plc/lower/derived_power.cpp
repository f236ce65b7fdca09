// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/derived_power.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "control/plc/library/standard.h"
#include "control/plc/model/elementary.h"
#include "control/plc/model/identifier.h"

namespace indurop::plc::lower {
namespace {

using network::Element;
using network::Network;
using network::Pin;
using network::Sheet;
using Kind = Element::Kind;

// Returns the names in a text like "axes[i].ready", in capitals. For addresses, which overlap, only "%".
std::set<std::string> names_in(std::string_view text) {
  std::set<std::string> out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_identifier(text.substr(i, end + 1 - i))) {
      ++end;
    }
    if (text[i] == '%') {
      out.insert("%");
    } else if (end > i) {
      out.insert(upper(text.substr(i, end - i)));
    }
    i = std::max(end, i + 1);
  }
  return out;
}

// Returns true for elements that run code outside of this network: it may write anything.
bool runs_other_code(const Element& element) {
  const bool known = find_block(element.type) != nullptr || !find_functions(element.type).empty();
  return element.kind == Kind::Block && (!known || element.inlined != nullptr || !element.in_outs.empty());
}

struct Written {
  bool anything = false;
  std::set<std::string> names;

  void add(std::string_view text) { names.merge(names_in(text)); }

  [[nodiscard]] bool meets(std::string_view text) const {
    const std::set<std::string> read = names_in(text);
    return anything || text.find('(') != std::string_view::npos ||
           std::any_of(read.begin(), read.end(), [&](const std::string& one) { return names.contains(one); });
  }
};

Written written_in(const Network& network) {
  Written out;
  for (const Element* element : network.elements) {
    out.anything = out.anything || runs_other_code(*element);
    out.add(element->instance);
    if (element->kind == Kind::Coil || element->kind == Kind::OutVariable || element->kind == Kind::InOutVariable) {
      out.add(element->text);
    }
    for (const Pin& pin : element->outputs) {
      out.add(pin.expression);
    }
  }
  return out;
}

// Returns true for power from rails, contacts and coils only.
bool is_plain_power(const Pin& pin, const Sheet& sheet) {
  return !pin.negated && pin.edge == ast::Edge::None && pin.expression.empty() && !pin.connections.empty() &&
         std::all_of(pin.connections.begin(), pin.connections.end(), [&](const network::Connection& one) {
           const Element* source = sheet.index.source(one).element;
           return source != nullptr && !sheet.order.feedback.contains(&one) &&
                  (source->kind == Kind::LeftRail || source->kind == Kind::Contact || source->kind == Kind::Coil);
         });
}

// Returns whether networks may be jumped over: there is no power then, even if contacts are closed.
bool has_jumps(const Sheet& sheet) {
  return std::any_of(sheet.order.elements.begin(), sheet.order.elements.end(), [](const Element* one) {
    return one->kind == Kind::Jump || one->kind == Kind::Return || one->inlined != nullptr;
  });
}

}  // namespace

std::unordered_set<const Element*> derived_power(const Sheet& sheet) {
  std::unordered_set<const Element*> out;
  if (has_jumps(sheet)) {
    return out;
  }
  for (const Network& network : sheet.networks) {
    const Written written = written_in(network);
    for (const Element* element : network.elements) {
      const bool contact =
          element->kind == Kind::Contact && element->edge == ast::Edge::None && !written.meets(element->text);
      if ((contact || element->kind == Kind::Coil) && !element->inputs.empty() &&
          is_plain_power(element->inputs.front(), sheet)) {
        out.insert(element);
      }
    }
  }
  return out;
}

}  // namespace indurop::plc::lower
