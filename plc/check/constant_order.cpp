// SPDX-License-Identifier: Apache-2.0
#include "plc/check/constant_order.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace indurop::plc {
namespace {

void collect(const ast::Expression& expression, std::vector<std::string>& to) {
  if (expression.kind == ast::Expression::Kind::Name) {
    to.push_back(upper(expression.name));
  }
  for (const ast::Expression& one : expression.operands) {
    collect(one, to);
  }
  for (const ast::Argument& one : expression.arguments) {
    if (one.value) {
      collect(*one.value, to);
    }
  }
}

void collect(const ast::Initial& initial, std::vector<std::string>& to) {
  if (initial.value) {
    collect(*initial.value, to);
  }
  for (const ast::InitialElement& one : initial.elements) {
    collect(one.value, to);
  }
}

class Order {
 public:
  explicit Order(std::vector<ast::Variable>& variables) : variables_(variables) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (is_constant(i)) {
        names_.emplace(upper(variables[i].name), i);
      }
    }
  }

  void run() {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (is_constant(i)) {
        visit(i);
      }
    }
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (!is_constant(i)) {
        order_.push_back(i);
      }
    }
    std::vector<ast::Variable> sorted;
    sorted.reserve(order_.size());
    for (const std::size_t i : order_) {
      sorted.push_back(std::move(variables_[i]));
    }
    variables_ = std::move(sorted);
  }

 private:
  [[nodiscard]] bool is_constant(std::size_t i) const {
    const ast::Variable& one = variables_[i];
    return one.constant && (one.section == ast::Section::Local || one.section == ast::Section::Global);
  }

  void visit(std::size_t i) {
    if (!seen_.insert(i).second) {
      return;
    }
    std::vector<std::string> needed;
    if (variables_[i].initial) {
      collect(*variables_[i].initial, needed);
    }
    for (const std::string& name : needed) {
      if (const auto found = names_.find(name); found != names_.end()) {
        visit(found->second);
      }
    }
    order_.push_back(i);
  }

  std::vector<ast::Variable>& variables_;
  std::set<std::size_t> seen_;
  std::map<std::string, std::size_t> names_;
  std::vector<std::size_t> order_;
};

}  // namespace

void order_constants(std::vector<ast::Variable>& variables) {
  Order(variables).run();
}

void order_constants(Project& project) {
  order_constants(project.globals);
  for (Configuration& configuration : project.configurations) {
    order_constants(configuration.globals);
    for (Resource& resource : configuration.resources) {
      order_constants(resource.globals);
    }
  }
  for (ast::Pou& pou : project.pous) {
    order_constants(pou.variables);
  }
}

}  // namespace indurop::plc
