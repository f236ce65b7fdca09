// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/access_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/designator.h"
#include "control/plc/check/expression_checker.h"
#include "control/plc/check/located_variables.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/check/type_builder.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

// Splits resource.program.instance.list[3] into its parts, the outermost first.
void flatten(ast::Expression& expression, std::vector<ast::Expression*>& parts) {
  const bool inner =
      expression.kind == ast::Expression::Kind::Member || expression.kind == ast::Expression::Kind::Index;
  if (inner) {
    flatten(expression.operands.front(), parts);
  }
  parts.push_back(&expression);
}

class Walker {
 public:
  Walker(Context& context, const Place& at, std::string_view what) : context_(context), at_(at), what_(what) {}

  // Resolves a path. `home`: the program in which the path is written, null: a configuration.
  std::optional<Reached> run(ast::Expression& path, const Pou* home) {
    std::vector<ast::Expression*> parts;
    flatten(path, parts);
    parts_ = std::move(parts);
    if (!begin(home)) {
      return std::nullopt;
    }
    for (; next_ < parts_.size(); ++next_) {
      if (!step(*parts_[next_])) {
        return std::nullopt;
      }
    }
    if (found_.type == nullptr) {
      fail(fmt::format("'{}' is a program, name a variable of it", parts_.back()->name));
      return std::nullopt;
    }
    return std::move(found_);
  }

 private:
  bool fail(const std::string& text) {
    context_.error(at_, fmt::format("{}: {}", what_, text));
    return false;
  }

  bool begin(const Pou* home) {
    ast::Expression& first = *parts_.front();
    if (first.kind == ast::Expression::Kind::Direct) {
      return at_global(located_global(context_, first.address, at_), 1);
    }
    if (first.kind != ast::Expression::Kind::Name) {
      return fail("write resource.program.variable, a global variable or an address");
    }
    if (home != nullptr) {
      found_.program = home;
      return true;
    }
    return at_instance() || at_named_global() || unknown();
  }

  bool unknown() {
    const bool known = context_.known_errors.contains({nullptr, upper(parts_.front()->name)});
    return known ? false : fail(fmt::format("there is no program or global variable '{}'", parts_.front()->name));
  }

  // Matches an instance of a program. The resource may be omitted.
  bool at_instance() {
    const auto named = [&](std::size_t part, const std::string& name) {
      return part < parts_.size() && same_name(parts_[part]->name, name);
    };
    for (const Configuration& configuration : context_.program.project.configurations) {
      for (const Resource& resource : configuration.resources) {
        for (const ProgramInstance& one : resource.programs) {
          const std::size_t at = named(0, resource.name) && named(1, one.name) ? 1 : 0;
          if (named(at, one.name) && program(one.type)) {
            found_.instance = &one;
            next_ = at + 1;
            return true;
          }
        }
      }
    }
    if (program(parts_.front()->name)) {
      next_ = 1;
      return true;
    }
    return false;
  }

  bool program(const std::string& type) {
    const auto pou = context_.program.pou_names.find(upper(type));
    const bool found = pou != context_.program.pou_names.end() && pou->second->tree->kind == ast::Pou::Kind::Program;
    found_.program = found ? pou->second : found_.program;
    return found;
  }

  // Matches a global, with or without the resource or configuration before it.
  bool at_named_global() {
    for (std::size_t i = 0; i < 2 && i < parts_.size(); ++i) {
      const auto global = context_.program.global_names.find(upper(parts_[i]->name));
      if (global != context_.program.global_names.end() && (i == 0 || is_resource(parts_[0]->name))) {
        return at_global(*global->second, i + 1);
      }
    }
    return false;
  }

  [[nodiscard]] bool is_resource(const std::string& name) const {
    const auto& all = context_.program.project.configurations;
    return std::any_of(all.begin(), all.end(), [&](const Configuration& one) {
      return same_name(one.name, name) ||
             std::any_of(one.resources.begin(), one.resources.end(),
                         [&](const Resource& resource) { return same_name(resource.name, name); });
    });
  }

  bool at_global(const Global& global, std::size_t next) {
    found_ = {};
    found_.global = &global;
    found_.type = global.type;
    found_.constant = global.kind == Global::Kind::Fixed;
    found_.input = global.address.starts_with("%I");
    next_ = next;
    return true;
  }

  bool step(ast::Expression& part) {
    if (part.kind == ast::Expression::Kind::Index) {
      return element(part);
    }
    const Pou* holder = found_.type == nullptr                   ? found_.program
                        : found_.type->kind == Type::Kind::Block ? found_.type->pou
                                                                 : nullptr;
    if (holder != nullptr) {
      return variable(*holder, part.name);
    }
    if (found_.type->kind == Type::Kind::Block) {
      return pin(*found_.type->block, part.name);
    }
    if (found_.type->kind == Type::Kind::Struct) {
      const auto& fields = found_.type->fields;
      const auto field =
          std::find_if(fields.begin(), fields.end(), [&](const Field& one) { return same_name(one.name, part.name); });
      if (field != fields.end()) {
        return go({.field = &*field}, field->type);
      }
    }
    return fail(fmt::format("{} has no '{}'", with_article(*found_.type), part.name));
  }

  bool go(Reached::Step step, const Type* type) {
    found_.steps.push_back(std::move(step));
    found_.type = type;
    return type != nullptr;  // else its declaration has an error
  }

  bool variable(const Pou& holder, const std::string& name) {
    Variable* one = holder.find(upper(name));
    if (one == nullptr) {
      return fail(fmt::format("{} has no variable '{}'", holder.name, name));
    }
    one->used = true;
    one->written = true;
    if (one->global != nullptr) {
      return at_global(*one->global, next_);
    }
    if (one->section == ast::Section::Temp || one->section == ast::Section::InOut) {
      return fail(fmt::format("'{}' is there only while {} runs, declare it as VAR", name, holder.name));
    }
    found_.constant = one->is_constant;
    return go({.variable = one}, one->type);
  }

  bool pin(const LibraryBlock& block, const std::string& name) {
    const LibraryParameter* one = block.input(name) != nullptr ? block.input(name) : block.output(name);
    const Elementary* type = one != nullptr ? std::get_if<Elementary>(&one->type) : nullptr;
    return type != nullptr ? go({.pin = one}, context_.elementary(*type))
                           : fail(fmt::format("{} has no '{}'", block.name, name));
  }

  bool element(ast::Expression& part) {
    const bool fits = found_.type != nullptr && found_.type->kind == Type::Kind::Array &&
                      found_.type->dimensions.size() + 1 == part.operands.size();
    if (!fits) {
      return fail("there is no array with that many dimensions");
    }
    Reached::Step step;
    for (std::size_t i = 1; i < part.operands.size(); ++i) {
      const auto index = ExpressionChecker(context_).constant(part.operands[i], "the index");
      if (!index) {
        return false;
      }
      const Bounds& bounds = found_.type->dimensions[i - 1];
      if (*index < bounds.low || *index > bounds.high) {
        return fail(fmt::format("the index {} is outside of {}..{}", *index, bounds.low, bounds.high));
      }
      step.index.push_back(static_cast<std::uint64_t>(*index - bounds.low));
    }
    return go(std::move(step), found_.type->element);
  }

  Context& context_;
  Place at_;
  std::string_view what_;
  std::vector<ast::Expression*> parts_;
  std::size_t next_ = 0;
  Reached found_;
};

class Resolver {
 public:
  explicit Resolver(Context& context) : context_(context) {}

  void access(Access& one) {
    const Pou* home = nullptr;
    if (!one.program.empty()) {
      const auto pou = context_.program.pou_names.find(upper(one.program));
      if (pou == context_.program.pou_names.end()) {
        return;  // its error was reported
      }
      home = pou->second;
    }
    const Type* type = build_type(context_, one.type);
    auto to = Walker(context_, one.at, "VAR_ACCESS").run(one.to, home);
    if (type == nullptr || !to || !is_right(one, *type, *to)) {
      return;
    }
    AccessPath made;
    made.at = one.at;
    made.name = one.name;
    made.type = to->type;
    made.writable = one.writable;
    made.to = std::move(*to);
    made.of_each_instance = home != nullptr;
    context_.program.accesses.push_back(std::move(made));
  }

  void connections(ProgramInstance& instance) {
    const auto pou = context_.program.pou_names.find(upper(instance.type));
    if (pou == context_.program.pou_names.end() || pou->second->tree->kind != ast::Pou::Kind::Program) {
      return;
    }
    for (Connection& one : instance.connections) {
      connection(one, *pou->second, context_.program.connections[&instance]);
    }
  }

 private:
  bool fail(const Place& at, const std::string& text) {
    context_.error(at, text);
    return false;
  }

  bool is_right(const Access& one, const Type& type, const Reached& to) {
    if (!same_type(type, *to.type)) {
      return fail(one.at, fmt::format("VAR_ACCESS: the variable is {}, use that type", with_article(*to.type)));
    }
    if (is_private(type)) {
      return fail(one.at,
                  fmt::format("VAR_ACCESS: {} cannot be seen from outside, name its variables", with_article(type)));
    }
    if (one.writable && (to.constant || to.input)) {
      return fail(one.at,
                  fmt::format("VAR_ACCESS: {} is not written, use READ_ONLY", to.constant ? "a CONSTANT" : "an input"));
    }
    if (to.global != nullptr && to.global->kind == Global::Kind::Foreign) {
      return fail(one.at, "VAR_ACCESS: the variable is one of a .glb file, which everybody sees already");
    }
    if (context_.program.global_names.contains(upper(one.name)) || !names_.insert(upper(one.name)).second) {
      return fail(one.at, fmt::format("VAR_ACCESS: there is a variable '{}' already, use another name", one.name));
    }
    return true;
  }

  void connection(Connection& one, const Pou& pou, std::vector<ConnectedPin>& to) {
    Variable* parameter = pou.find(upper(one.parameter));
    const ast::Section wanted = one.output ? ast::Section::Output : ast::Section::Input;
    if (parameter == nullptr || parameter->section != wanted) {
      fail(one.at, fmt::format("{} has no {} '{}'", pou.name, one.output ? "output" : "input", one.parameter));
      return;
    }
    if (parameter->type == nullptr) {
      return;
    }
    parameter->used = true;
    parameter->written = true;
    const bool twice =
        std::any_of(to.begin(), to.end(), [&](const ConnectedPin& each) { return each.parameter == parameter; });
    if (twice && !one.output) {
      fail(one.at, fmt::format("'{}' is connected twice, remove one of the connections", one.parameter));
      return;
    }
    ConnectedPin made;
    made.parameter = parameter;
    if (!one.output && !is_path(one.value)) {
      one.initial.emplace();
      one.initial->at = one.at;
      one.initial->value = one.value;
      if (!ExpressionChecker(context_).initials().initial(*one.initial, *parameter->type)) {
        return;
      }
      made.value = &*one.initial;
    } else {
      auto other = Walker(context_, one.at, one.parameter).run(one.value, nullptr);
      if (!other || !fits(one, *parameter->type, *other)) {
        return;
      }
      made.other = std::move(*other);
    }
    to.push_back(std::move(made));
  }

  // Returns true for a variable, false for a value.
  [[nodiscard]] bool is_path(const ast::Expression& value) const {
    const ast::Expression& root = root_of(value);
    return value.kind == ast::Expression::Kind::Direct ||
           (root.kind == ast::Expression::Kind::Name && value.kind != ast::Expression::Kind::Call &&
            context_.program.global_names.contains(upper(root.name)));
  }

  bool fits(const Connection& one, const Type& parameter, const Reached& other) {
    if (other.global == nullptr) {
      return fail(one.at, fmt::format("'{}' is connected with global variables and addresses only", one.parameter));
    }
    if (one.output && (other.constant || other.input)) {
      return fail(one.at, fmt::format("{} is not written, connect '{}' with another variable",
                                      other.constant ? "a CONSTANT" : "an input", one.parameter));
    }
    const Type& from = one.output ? parameter : *other.type;
    const Type& to = one.output ? *other.type : parameter;
    const bool address = one.value.kind == ast::Expression::Kind::Direct && from.kind == Type::Kind::Elementary &&
                         to.kind == Type::Kind::Elementary && bits_of(from.elementary) == bits_of(to.elementary) &&
                         is_real(from.elementary) == is_real(to.elementary);
    return address || (context_.assignable(from, to) && in_range_of(from, to)) ||
           fail(one.at,
                fmt::format("'{}': {} is not given to {}", one.parameter, with_article(from), with_article(to)));
  }

  Context& context_;
  std::set<std::string> names_;
};

}  // namespace

void resolve_accesses(Context& context) {
  Resolver resolver(context);
  for (Access& one : context.program.project.accesses) {
    resolver.access(one);
  }
  for (Configuration& configuration : context.program.project.configurations) {
    for (Resource& resource : configuration.resources) {
      for (ProgramInstance& one : resource.programs) {
        resolver.connections(one);
      }
    }
  }
}

}  // namespace indurop::plc
