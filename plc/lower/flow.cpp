// SPDX-License-Identifier: Apache-2.0
#include "plc/lower/flow.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "plc/model/make.h"

namespace indurop::plc::lower {
namespace {

using Kind = FlowPoint::Kind;

constexpr const char* kEnd = "_flow_end";
constexpr std::size_t kBits = 8;

ast::Expression number(const Place& at, std::uint64_t value) {
  ast::Expression literal;
  literal.at = at;
  literal.value = value;
  return literal;
}

// main_flow[3].5
ast::Expression bit_of(const Place& at, const std::string& variable, std::size_t bit) {
  ast::Expression byte;
  byte.kind = ast::Expression::Kind::Index;
  byte.at = at;
  byte.operands.push_back(make::name(at, variable));
  byte.operands.push_back(number(at, bit / kBits));
  ast::Expression made;
  made.kind = ast::Expression::Kind::Bit;
  made.at = at;
  made.bit = static_cast<unsigned>(bit % kBits);
  made.operands.push_back(std::move(byte));
  return made;
}

// Through the end of the body, where the flow is written.
bool leave_through_end(ast::Body& body, const Place& at) {
  bool found = false;
  for (ast::Statement& statement : body) {
    if (statement.kind == ast::Statement::Kind::Return) {
      statement.kind = ast::Statement::Kind::Jump;
      statement.label = kEnd;
      found = true;
    }
  }
  if (found) {
    body.push_back(make::label(at, kEnd));
  }
  return found;
}

}  // namespace

std::string flow_variable(const std::string& pou) {
  return pou + "_flow";
}

std::string value_variable(const std::string& pou, const Source& source) {
  return fmt::format("{}_value_{}_{}", pou, source.element->id, source.pin->name);
}

void add_flow(LoweredNetworks& lowered, const ast::Pou& pou, std::vector<ast::Variable>& globals) {
  const auto declare = [&](std::string name, ast::TypeSpec type) {
    globals.push_back(make::variable(ast::Section::Global, name, type));
    lowered.variables.push_back(make::variable(ast::Section::External, std::move(name), std::move(type)));
  };
  leave_through_end(lowered.body, pou.at);
  const std::string flow = flow_variable(pou.name);
  std::size_t bits = 0;
  for (FlowPoint& point : lowered.flow) {
    const Place at = point.value.at;
    if (point.kind == Kind::Value) {
      const std::string name = value_variable(pou.name, point.source);
      declare(name, make::type(pou.at, point.type));
      lowered.body.push_back(make::assign(make::name(at, name), std::move(point.value)));
    } else {
      lowered.body.push_back(make::assign(bit_of(at, flow, bits++), std::move(point.value)));
    }
  }
  if (bits > 0) {
    ast::TypeSpec bytes;
    bytes.kind = ast::TypeSpec::Kind::Array;
    bytes.at = pou.at;
    bytes.dimensions.push_back({number(pou.at, 0), number(pou.at, (bits - 1) / kBits)});
    bytes.element = std::make_shared<ast::TypeSpec>(make::type(pou.at, Elementary::Byte));
    declare(flow, std::move(bytes));
  }
}

}  // namespace indurop::plc::lower
