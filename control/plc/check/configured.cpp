// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/configured.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/located_variables.h"
#include "control/plc/check/type_builder.h"

namespace indurop::plc {
namespace {

class Configurer {
 public:
  Configurer(Context& context, Configured& entry) : context_(context), entry_(entry) {}

  void run() {
    ast::Pou* pou = program();
    for (std::size_t i = first_ + 1; pou != nullptr && i < entry_.path.size(); ++i) {
      variable_ = find(*pou, entry_.path[i]);
      if (variable_ == nullptr) {
        error(fmt::format("{} has no variable '{}'", pou->name, entry_.path[i]));
        return;
      }
      if (i + 1 == entry_.path.size()) {
        set(i == first_ + 1);
        return;
      }
      outer_ = outer_ == nullptr ? variable_ : outer_;
      pou = block_of(*variable_);
      if (pou == nullptr) {
        error(
            fmt::format("{} is no instance of a function block of the project; elements of arrays cannot be "
                        "configured",
                        entry_.path[i]));
      }
    }
  }

 private:
  void error(std::string text) { context_.error(entry_.at, "VAR_CONFIG: " + std::move(text)); }

  // Finds the program; the resource may be omitted. Stores the position of the program's instance in the path.
  ast::Pou* program() {
    const ProgramInstance* instance = nullptr;
    bool configured = false;
    std::vector<const ProgramInstance*> instances;
    for (const Configuration& configuration : context_.program.project.configurations) {
      for (const Resource& resource : configuration.resources) {
        const bool named = entry_.path.size() > 2 && same_name(resource.name, entry_.path[0]);
        for (const ProgramInstance& one : resource.programs) {
          configured = true;
          instances.push_back(&one);
          if (same_name(one.name, entry_.path[named ? 1 : 0])) {
            instance = &one;
            first_ = named ? 1 : 0;
          }
        }
      }
    }
    const std::string& wanted = instance != nullptr ? instance->type : entry_.path[0];
    ast::Pou* found = pou_named(wanted, ast::Pou::Kind::Program);
    if (found == nullptr || entry_.path.size() < first_ + 2 ||
        (configured && instance == nullptr && !context_.codesys())) {
      error(fmt::format("there is no program '{}', write resource.program.variable", entry_.path[0]));
      return nullptr;
    }
    instance_ = instance != nullptr ? instance->name : found->name;
    for (const ProgramInstance* one : instances) {
      if (one != instance && same_name(one->type, wanted)) {
        other_ = one->name;
      }
    }
    return found;
  }

  ast::Pou* pou_named(const std::string& name, ast::Pou::Kind kind) {
    auto& pous = context_.program.project.pous;
    const auto found = std::find_if(pous.begin(), pous.end(),
                                    [&](const ast::Pou& one) { return one.kind == kind && same_name(one.name, name); });
    return found == pous.end() ? nullptr : &*found;
  }

  ast::Pou* block_of(const ast::Variable& variable) {
    return variable.type.kind == ast::TypeSpec::Kind::Named
               ? pou_named(variable.type.name, ast::Pou::Kind::FunctionBlock)
               : nullptr;
  }

  ast::Variable* find(ast::Pou& pou, const std::string& name) {
    for (ast::Variable& one : pou.variables) {
      if (same_name(one.name, name)) {
        return &one;
      }
    }
    ast::Pou* base = pou.bases.empty() ? nullptr : pou_named(pou.bases.front().name, ast::Pou::Kind::FunctionBlock);
    return base != nullptr && base != &pou ? find(*base, name) : nullptr;
  }

  void set(bool of_program) {
    const Type* type = build_type(context_, entry_.type);
    const Type* declared = type != nullptr ? build_type(context_, variable_->type) : nullptr;
    if (declared == nullptr) {
      return;
    }
    if (!same_type(*type, *declared)) {
      error(fmt::format("{} is {} where it is declared, use that type", variable_->name, with_article(*declared)));
      return;
    }
    const bool inside = entry_.address && !of_program;
    if (!inside && !other_.empty()) {  // both set a variable of the program, shared by its instances
      error(
          fmt::format("{} and {} are of one program, and what is configured would be so in both; declare a program of "
                      "its own for {}",
                      instance_, other_, instance_));
      return;
    }
    if (inside && entry_.initial) {
      error(fmt::format("{} gets its place here, and its initial value where it is declared, or by a statement",
                        variable_->name));
      return;
    }
    if (entry_.address) {
      place(*type, of_program);
    }
    if (entry_.initial && of_program) {
      variable_->initial = entry_.initial;
    } else if (entry_.initial) {
      initial();
    }
  }

  void place(const Type& type, bool of_program) {
    const bool open = variable_->address && variable_->address->numbers.empty();
    if (!open || variable_->address->area != entry_.address->area || entry_.address->numbers.empty()) {
      error(fmt::format("{0} gets a place of %{1} only if it is declared as {0} AT %{1}*", variable_->name,
                        entry_.address->area));
      return;
    }
    if (of_program) {
      variable_->address = entry_.address;
      return;
    }
    ast::Variable made;
    made.section = ast::Section::Global;
    made.at = entry_.at;
    made.address = entry_.address;
    made.type = entry_.type;
    std::string name = instance_;
    for (std::size_t i = first_ + 1; i < entry_.path.size(); ++i) {
      name += "_" + entry_.path[i];
    }
    context_.program.placed[upper(name)] = &declare_located(context_, made, type);
  }

  // Appends (motor := (speed := 3)) to the existing values.
  void initial() {
    std::optional<ast::Initial>* at = &outer_->initial;
    for (std::size_t i = first_ + 2; i < entry_.path.size(); ++i) {
      if (!*at) {
        at->emplace();
        (*at)->kind = ast::Initial::Kind::Struct;
        (*at)->at = entry_.at;
      }
      if ((*at)->kind != ast::Initial::Kind::Struct || i + 1 < entry_.path.size()) {
        error("initial values are those of variables of programs, and of inputs and outputs of their instances");
        return;
      }
      ast::InitialElement& one = (*at)->elements.emplace_back();
      one.field = entry_.path[i];
      one.value = *entry_.initial;
    }
  }

  Context& context_;
  Configured& entry_;
  std::size_t first_ = 0;  // position of the program in the path
  std::string instance_;
  std::string other_;  // another instance of the same program
  ast::Variable* variable_ = nullptr;
  ast::Variable* outer_ = nullptr;  // the variable of the program that contains it
};

}  // namespace

void apply_configured(Context& context) {
  for (Configured& one : context.program.project.configured) {
    Configurer(context, one).run();
  }
}

}  // namespace indurop::plc
