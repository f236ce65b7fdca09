// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/constant_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

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
  Order(std::vector<ast::Variable>& variables, Diagnostics& diagnostics)
      : variables_(variables), diagnostics_(diagnostics) {
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
    open_.push_back(i);
    for (const std::string& name : needed) {
      const auto found = names_.find(name);
      if (found == names_.end()) {
        continue;
      }
      if (std::find(open_.begin(), open_.end(), found->second) != open_.end()) {
        circle(found->second);
      } else {
        visit(found->second);
      }
    }
    open_.pop_back();
    order_.push_back(i);
  }

  // Reports a circle once; the declarations count as errors, so that their uses are not reported.
  void circle(std::size_t first) {
    std::string way;
    for (auto one = std::find(open_.begin(), open_.end(), first); one != open_.end(); ++one) {
      way += variables_[*one].name + " -> ";
      variables_[*one].type.kind = ast::TypeSpec::Kind::Inferred;
      variables_[*one].initial.reset();
    }
    diagnostics_.error(variables_[first].at,
                       fmt::format("a constant cannot need its own value: {}{}, give one of them a number", way,
                                   variables_[first].name));
  }

  std::vector<ast::Variable>& variables_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> open_;  // in progress
  std::set<std::size_t> seen_;
  std::map<std::string, std::size_t> names_;
  std::vector<std::size_t> order_;
};

void order_constants(std::vector<ast::Variable>& variables, Diagnostics& diagnostics) {
  Order(variables, diagnostics).run();
}

}  // namespace

void order_constants(Project& project, Diagnostics& diagnostics) {
  order_constants(project.globals, diagnostics);
  for (Configuration& configuration : project.configurations) {
    order_constants(configuration.globals, diagnostics);
    for (Resource& resource : configuration.resources) {
      order_constants(resource.globals, diagnostics);
    }
  }
  for (ast::Pou& pou : project.pous) {
    order_constants(pou.variables, diagnostics);
  }
}

}  // namespace indurop::plc
