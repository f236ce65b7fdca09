// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/blocks.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/library/standard.h"
#include "control/plc/model/make.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::lower {
namespace {

bool is_enable(const Pin& pin) noexcept {
  return same_name(pin.name, "EN");
}
bool is_enabled(const Pin& pin) noexcept {
  return same_name(pin.name, "ENO");
}

ast::Expression with_sign(const Pin& pin, ast::Expression value) {
  return pin.negated ? make::negation(std::move(value)) : std::move(value);
}

// Returns the pin of a function's result: named like it or OUT, else its first one.
const Pin* result_pin(const Element& element) noexcept {
  const Pin* first = nullptr;
  for (const Pin& pin : element.outputs) {
    if (same_name(pin.name, element.type) || same_name(pin.name, "OUT")) {
      return &pin;
    }
    first = first == nullptr && !is_enabled(pin) ? &pin : first;
  }
  return first;
}

bool gives_bool(const std::string& function) {
  const auto overloads = find_functions(function);
  return !overloads.empty() && std::all_of(overloads.begin(), overloads.end(), [](const LibraryFunction* each) {
    const auto* fixed = std::get_if<Elementary>(&each->result);
    return fixed != nullptr && *fixed == Elementary::Bool;
  });
}

const ast::Pou* find_pou(const Project* project, const std::string& name) noexcept {
  if (project == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(project->pous.begin(), project->pous.end(),
                                  [&](const ast::Pou& pou) { return same_name(pou.name, name); });
  return found == project->pous.end() ? nullptr : &*found;
}

const ast::Variable* find_variable(const ast::Pou* pou, const std::string& name) noexcept {
  if (pou == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(pou->variables.begin(), pou->variables.end(),
                                  [&](const ast::Variable& variable) { return same_name(variable.name, name); });
  return found == pou->variables.end() ? nullptr : &*found;
}

}  // namespace

// A function of the project replaces that of the library.
bool BlockLowering::is_standard(const std::string& function) const {
  return !find_functions(function).empty() && find_pou(options_.project, function) == nullptr;
}

void BlockLowering::block(const Element& element) {
  std::string enable;
  for (const Pin& pin : element.inputs) {
    if (is_enable(pin) && (!pin.connections.empty() || !pin.expression.empty())) {
      ast::Expression power = code_.input(element, pin);
      enable = code_.temporary("en", key_of(element), make::type(element.at, Elementary::Bool));
      code_.add(make::assign(make::name(element.at, enable), std::move(power)));
    }
  }
  for (const Pin& pin : element.outputs) {
    if (is_enabled(pin)) {
      ast::Expression value = enable.empty() ? make::truth(element.at, true) : make::name(element.at, enable);
      code_.define(element, &pin, value);
      code_.show(FlowPoint::Kind::Power, {&element, &pin}, std::move(value));
    }
  }
  if (element.inlined != nullptr) {
    code(element, enable);
  } else if (element.instance.empty()) {
    function(element, enable);
  } else {
    instance(element, enable);
  }
}

void BlockLowering::add(ast::Statement statement, const std::string& enable) {
  if (enable.empty()) {
    code_.add(std::move(statement));
    return;
  }
  const Place at = statement.at;
  ast::Body body;
  body.push_back(std::move(statement));
  code_.add(make::when(make::name(at, enable), std::move(body)));
}

std::vector<ast::Argument> BlockLowering::arguments(const Element& element, bool named) {
  std::vector<ast::Argument> arguments;
  for (const auto* pins : {&element.inputs, &element.in_outs}) {
    for (const Pin& pin : *pins) {
      if (!is_enable(pin) && (!pin.connections.empty() || !pin.expression.empty())) {
        arguments.push_back(make::argument(named ? pin.name : std::string(), code_.input(element, pin)));
        arguments.back().at = pin.at;
      }
    }
  }
  return arguments;
}

// Translates Structured Text in a box. The power after it equals the power before it.
void BlockLowering::code(const Element& element, const std::string& enable) {
  std::optional<Place> c_code;
  ast::Body body = st::parse_body({element.inlined->text, element.inlined->text_at}, c_code, code_.diagnostics());
  if (c_code) {
    code_.diagnostics().error(*c_code, "C code in { } is not supported, write it in ST, or as a module of its own");
  }
  ast::Expression power = enable.empty() ? make::truth(element.at, true) : make::name(element.at, enable);
  code_.add(make::when(power, std::move(body)));
  for (const Pin& pin : element.outputs) {
    if (!is_enabled(pin)) {
      code_.define(element, &pin, with_sign(pin, power));
    }
  }
}

void BlockLowering::instance(const Element& element, const std::string& enable) {
  auto callee = code_.parse(element.instance, element.at);
  if (!callee) {
    return;
  }
  std::vector<ast::Argument> given = arguments(element, true);
  ast::Expression call = make::call(element.at, *callee, std::move(given));
  call.name = element.type;
  add(make::call_statement(std::move(call)), enable);
  for (const Pin& pin : element.outputs) {
    if (is_enabled(pin)) {
      continue;
    }
    ast::Expression output;
    output.kind = ast::Expression::Kind::Member;
    output.at = pin.at;
    output.name = pin.name;
    output.operands.push_back(*callee);
    ast::Expression value = with_sign(pin, std::move(output));
    const ast::TypeSpec type = output_type(element, pin);
    if (type.kind == ast::TypeSpec::Kind::Elementary) {
      const bool power = type.elementary == Elementary::Bool;
      code_.show(power ? FlowPoint::Kind::Power : FlowPoint::Kind::Value, {&element, &pin}, value, type.elementary);
    }
    code_.define(element, &pin, std::move(value));
  }
  for (const Pin& pin : element.in_outs) {
    if (!pin.connections.empty()) {
      code_.define(element, &pin, code_.input(element, pin));
    }
  }
  store_outputs(element, enable);
}

void BlockLowering::function(const Element& element, const std::string& enable) {
  const Pin* result = result_pin(element);
  const bool standard = is_standard(element.type);
  std::vector<ast::Argument> given = arguments(element, !standard);
  further_outputs(element, result, given);
  ast::Expression call = make::call(element.at, make::name(element.at, element.type), std::move(given));
  if (result == nullptr) {
    add(make::call_statement(std::move(call)), enable);
    return;
  }
  if (standard && gives_bool(element.type)) {
    const std::string name = code_.temporary("p", fmt::format("{}_{}", key_of(element), result->name),
                                             make::type(element.at, Elementary::Bool));
    ast::Expression power =
        enable.empty() ? std::move(call) : make::both(make::name(element.at, enable), std::move(call));
    code_.add(make::assign(make::name(element.at, name), std::move(power)));
    code_.show(FlowPoint::Kind::Power, {&element, result}, with_sign(*result, make::name(element.at, name)));
    code_.define(element, result, with_sign(*result, make::name(element.at, name)), enable);
  } else {
    code_.defer(element, *result, with_sign(*result, std::move(call)), enable);
  }
  store_outputs(element, enable);
}

// Adds VAR_OUTPUT of a function of the project.
void BlockLowering::further_outputs(const Element& element, const Pin* result, std::vector<ast::Argument>& arguments) {
  for (const Pin& pin : element.outputs) {
    if (&pin == result || is_enabled(pin)) {
      continue;
    }
    const std::string name =
        code_.temporary("o", fmt::format("{}_{}", key_of(element), pin.name), output_type(element, pin));
    ast::Argument output = make::argument(pin.name, make::name(pin.at, name));
    output.output = true;
    arguments.push_back(std::move(output));
    code_.define(element, &pin, with_sign(pin, make::name(pin.at, name)));
  }
}

ast::TypeSpec BlockLowering::output_type(const Element& element, const Pin& pin) const {
  const LibraryBlock* block = find_block(element.type);
  if (block != nullptr && find_pou(options_.project, element.type) == nullptr) {
    const LibraryParameter* output = block->output(pin.name);
    const auto* fixed = output == nullptr ? nullptr : std::get_if<Elementary>(&output->type);
    return fixed == nullptr ? make::inferred_type(pin.at) : make::type(pin.at, *fixed);
  }
  const ast::Variable* declared = find_variable(find_pou(options_.project, element.type), pin.name);
  return declared == nullptr ? make::inferred_type(pin.at) : declared->type;
}

void BlockLowering::store_outputs(const Element& element, const std::string& enable) {
  for (const Pin& pin : element.outputs) {
    if (pin.expression.empty()) {
      continue;
    }
    auto target = code_.parse(pin.expression, pin.at);
    Value value = code_.output_value(element, pin);
    value.guard = enable;
    if (target) {
      code_.store(std::move(*target), std::move(value), pin.storage, false);
    }
  }
}

}  // namespace indurop::plc::lower
