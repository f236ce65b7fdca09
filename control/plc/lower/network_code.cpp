// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/network_code.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/library/standard.h"
#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::lower {
namespace {

using Kind = Element::Kind;

constexpr std::size_t kDeepest = 64;  // nesting of operators

// Returns true for MAX(300, 1): its value cannot change.
bool is_fixed(const ast::Expression& expression) {
  switch (expression.kind) {
    case ast::Expression::Kind::Literal:
      return true;
    case ast::Expression::Kind::Unary:
    case ast::Expression::Kind::Binary:
      return std::all_of(expression.operands.begin(), expression.operands.end(), is_fixed);
    case ast::Expression::Kind::Call:
      return expression.operands[0].kind == ast::Expression::Kind::Name && !expression.arguments.empty() &&
             !find_functions(expression.operands[0].name).empty() &&
             std::all_of(expression.arguments.begin(), expression.arguments.end(),
                         [](const ast::Argument& one) { return !one.output && one.value && is_fixed(*one.value); });
    default:
      return false;
  }
}

}  // namespace

std::string key_of(const Element& element) {
  constexpr std::size_t kLongest = 32;
  std::string out = std::to_string(element.id);
  bool apart = true;  // a '_' comes before the next letter
  for (const char c : element.instance.empty() ? element.text + element.type : element.instance) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter && out.size() < kLongest) {
      out += apart ? "_" : "";
      out += c;
    }
    apart = !letter;
  }
  return out;
}

std::optional<ast::Expression> NetworkCode::parse(std::string_view text, const Place& at) {
  if (text.empty()) {
    return std::nullopt;  // reported by the check of the drawing
  }
  text.remove_suffix(text.ends_with(';') ? 1 : 0);  // TwinCAT accepts it
  return st::parse_expression({text, at}, diagnostics_);
}

Value NetworkCode::input_value(const Element& element, const Pin& pin, bool guarded) {
  Value all;
  if (!pin.expression.empty()) {
    all.expression = parse(pin.expression, pin.at).value_or(make::truth(pin.at, false));
  } else if (pin.connections.size() == 1) {
    all = value_of(pin.connections.front(), guarded);
  } else {
    std::vector<ast::Expression> values;
    for (const Connection& connection : pin.connections) {
      values.push_back(value_of(connection, false).expression);
    }
    all.expression = values.empty() ? make::truth(pin.at, false) : make::any_of(std::move(values));
  }
  if (pin.edge != ast::Edge::None) {
    all.expression = edge(std::move(all.expression), pin.edge, fmt::format("{}_{}", key_of(element), pin.name));
  }
  if (pin.negated) {
    all.expression = make::negation(std::move(all.expression));
  }
  return all;
}

ast::Expression NetworkCode::input(const Element& element, const Pin& pin) {
  return input_value(element, pin, false).expression;
}

Value NetworkCode::output_value(const Element& element, const Pin& pin) {
  return read({&element, &pin}, pin.at, true);
}

Value NetworkCode::value_of(const Connection& connection, bool guarded) {
  const Source source = sheet_.index.source(connection);
  if (source.element == nullptr) {
    return {make::truth(connection.at, false), {}};
  }
  if (sheet_.order.feedback.contains(&connection)) {
    return kept(source, connection.at);
  }
  return read(source, connection.at, guarded);
}

Value NetworkCode::kept(const Source& source, const Place& at) {
  const Element& element = *source.element;
  if (element.kind == Kind::Block && source.pin != nullptr) {
    ast::Expression value = make::member(at, element.instance, source.pin->name);
    return {source.pin->negated ? make::negation(std::move(value)) : std::move(value), {}};
  }
  return {parse(element.text, at).value_or(make::truth(at, false)), {}};
}

Value NetworkCode::read(const Source& source, const Place& at, bool guarded) {
  const Element& element = *source.element;
  switch (element.kind) {
    case Kind::LeftRail:
      return {make::truth(at, true), {}};
    case Kind::InVariable:
    case Kind::InOutVariable: {
      ast::Expression value = parse(element.text, element.at).value_or(make::truth(at, false));
      return {element.negated && element.kind == Kind::InVariable ? make::negation(std::move(value)) : std::move(value),
              {}};
    }
    case Kind::Continuation: {
      const Element* connector = sheet_.index.connector(element.text);
      return connector == nullptr || connector->inputs.empty()
                 ? Value{make::truth(at, false), {}}
                 : input_value(*connector, connector->inputs.front(), guarded);
    }
    default:
      break;
  }
  const Key key{source.element, source.pin};
  const auto output = outputs_.find(key);
  if (output == outputs_.end()) {
    return {make::truth(at, false), {}};  // its error was reported
  }
  Output& found = output->second;
  const bool moved = found.written != lowered_.body.size();
  if (found.deferred && is_fixed(found.value.expression) && (guarded || found.value.guard.empty())) {
    return found.value;  // the same wherever it is written; its type is that of the place
  }
  if (found.deferred && (moved || uses(key) > 1 || (!guarded && !found.value.guard.empty()))) {
    keep(key, found);
  }
  return found.value;
}

void NetworkCode::define(const Element& element, const Pin* pin, ast::Expression value, std::string guard) {
  outputs_[{&element, pin}] = {{std::move(value), std::move(guard)}, false, 0};
}

void NetworkCode::defer(const Element& element, const Pin& pin, ast::Expression value, std::string guard) {
  const bool deep = ast::depth_of(value) > kDeepest;
  Output& made = outputs_[{&element, &pin}];
  made = {{std::move(value), std::move(guard)}, true, lowered_.body.size()};
  if (deep) {
    keep({&element, &pin}, made);
  }
}

// Stores the value at the position of the function: the statement goes there, not to the end.
void NetworkCode::keep(const Key& key, Output& output) {
  const Place at = output.value.expression.at;
  const std::string name =
      temporary("t", fmt::format("{}_{}", key_of(*key.first), key.second == nullptr ? "" : key.second->name),
                make::inferred_type(at));
  ast::Statement statement = make::assign(make::name(at, name), std::move(output.value.expression));
  if (!output.value.guard.empty()) {
    ast::Body body;
    body.push_back(std::move(statement));
    statement = make::when(make::name(at, output.value.guard), std::move(body));
  }
  const std::size_t where = output.written;
  lowered_.body.insert(lowered_.body.begin() + static_cast<std::ptrdiff_t>(where), std::move(statement));
  for (auto& [other_key, other] : outputs_) {
    other.written += other.deferred && other.written >= where ? 1 : 0;
  }
  output.value.expression = make::name(at, name);
  output.deferred = false;
}

int NetworkCode::uses(const Key& key) {
  if (uses_.empty()) {
    for (const Element* element : sheet_.order.elements) {
      for (const Pin& pin : element->outputs) {
        uses_[{element, &pin}] += pin.expression.empty() ? 0 : 1;
      }
      for (const auto* pins : {&element->inputs, &element->in_outs}) {
        for (const Pin& pin : *pins) {
          for (const Connection& connection : pin.connections) {
            const Source source = sheet_.index.source(connection);
            ++uses_[{source.element, source.pin}];
          }
        }
      }
    }
  }
  return uses_[key];
}

std::string NetworkCode::declare(ast::Section section, std::string name, ast::TypeSpec type) {
  if (names_.insert(name).second) {
    lowered_.variables.push_back(make::variable(section, name, std::move(type)));
  }
  return name;
}

std::string NetworkCode::temporary(std::string_view letter, const std::string& key, ast::TypeSpec type) {
  return declare(ast::Section::Temp, fmt::format("_{}{}{}", letter, options_.prefix, key), std::move(type));
}

ast::Expression NetworkCode::power(const Element& element, ast::Expression value) {
  if (value.kind == ast::Expression::Kind::Name && value.name.starts_with("_p") && names_.contains(value.name)) {
    show(FlowPoint::Kind::Power, {&element, nullptr}, value);
    return value;
  }
  const std::string name = temporary("p", key_of(element), make::type(element.at, Elementary::Bool));
  add(make::assign(make::name(element.at, name), std::move(value)));
  show(FlowPoint::Kind::Power, {&element, nullptr}, make::name(element.at, name));
  return make::name(element.at, name);
}

ast::Expression NetworkCode::edge(ast::Expression value, ast::Edge edge, const std::string& key) {
  const Place at = value.at;
  const ast::TypeSpec type = make::type(at, Elementary::Bool);
  const std::string now = temporary("n", key, type);
  const std::string found = temporary("c", key, type);
  const std::string before = declare(ast::Section::Local, fmt::format("_e{}{}", options_.prefix, key), type);
  add(make::assign(make::name(at, now), std::move(value)));
  const bool rising = edge == ast::Edge::Rising;
  ast::Expression left = make::name(at, rising ? now : before);
  ast::Expression right = make::negation(make::name(at, rising ? before : now));
  add(make::assign(make::name(at, found), make::both(std::move(left), std::move(right))));
  add(make::assign(make::name(at, before), make::name(at, now)));
  return make::name(at, found);
}

void NetworkCode::store(ast::Expression target, Value value, Storage storage, bool negated) {
  const Place at = target.at;
  if (negated) {
    value.expression = make::negation(std::move(value.expression));
  }
  ast::Body body;
  if (storage == Storage::None) {
    body.push_back(make::assign(std::move(target), std::move(value.expression)));
  } else {
    ast::Body inner;
    inner.push_back(make::assign(std::move(target), make::truth(at, storage == Storage::Set)));
    body.push_back(make::when(std::move(value.expression), std::move(inner)));
  }
  add(value.guard.empty() ? std::move(body.front()) : make::when(make::name(at, value.guard), std::move(body)));
}

void NetworkCode::end_network() {
  for (auto point = lowered_.flow.rbegin(); point != lowered_.flow.rend() && point->behind == 0; ++point) {
    point->behind = lowered_.body.size();
  }
}

LoweredNetworks NetworkCode::finish() {
  end_network();
  for (const WantedPin& each : options_.wanted) {
    lowered_.wanted.push_back(input(*each.element, *each.pin));
  }
  return std::move(lowered_);
}

void NetworkCode::show(FlowPoint::Kind kind, const Source& source, ast::Expression value, Elementary type) {
  const bool derived = kind == FlowPoint::Kind::Power && derived_.contains(source.element);
  if (options_.flow && !derived) {
    lowered_.flow.push_back({kind, source, std::move(value), type});
  }
}

}  // namespace indurop::plc::lower
