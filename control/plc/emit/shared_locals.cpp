// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/shared_locals.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "control/plc/check/instance_contents.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/check/value_tree.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

// Returns true for variables made by the translation of a drawn program.
bool is_hidden(const Variable& variable) {
  return variable.name.starts_with('_');
}

bool is_kept(const Variable& variable, bool in_program) {
  const bool kept = variable.section == ast::Section::Local || variable.section == ast::Section::Input ||
                    variable.section == ast::Section::Output;
  return kept && variable.type != nullptr && variable.global == nullptr && !variable.is_constant &&
         (in_program || !variable.declared->is_static);
}

// The names of an instance, or of a variable in it, along the path to a value.
struct Way {
  std::string cpp;
  std::string name;
  bool retain = false;
  bool outside = false;                   // in a program, not in an instance inside it
  const ast::Initial* initial = nullptr;  // null: that of the type
};

// Returns (PT := T#1s) in the declaration of the instance.
const ast::Initial* initial_text_of(const Way& instance, const std::string& field) {
  if (instance.initial == nullptr) {
    return nullptr;
  }
  const auto& elements = instance.initial->elements;
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const ast::InitialElement& one) { return same_name(one.field, field); });
  return found == elements.end() ? nullptr : &found->value;
}

class Finder {
 public:
  Finder(const Program& program, bool show_locals, TaskUse& use)
      : program_(program), show_locals_(show_locals), use_(use) {}

  void pou(const Pou& pou, const Way& way) {
    for (const Variable* one : all_variables(pou)) {
      if (!is_kept(*one, way.outside)) {
        continue;
      }
      Way inner;
      inner.cpp = way.cpp + "." + cpp_name(std::string_view(one->name));
      inner.name = way.name + "_" + one->name;
      inner.retain = one->retain || (way.retain && !one->declared->non_retain);
      inner.outside = false;
      const ast::Initial* given = initial_text_of(way, one->name);
      inner.initial = given != nullptr ? given : one->declared->initial ? &*one->declared->initial : nullptr;
      const bool shown = way.outside && show_locals_ && !is_hidden(*one);
      if (holds_instances(*one->type)) {
        if (inner.retain || may_share(*one->type)) {
          instances(*one->type, inner);
        }
      } else if (is_placeless(*one) || ((inner.retain || shown) && !is_private(*one->type))) {
        add(*one->type, inner, one->declared);
      }
      if (inner.retain && one->declared->edge != ast::Edge::None) {
        use_.restored.push_back(fmt::format("{0}_before = {0};", inner.cpp));
      }
    }
  }

  void instances(const Type& type, const Way& way) {
    if (type.kind == Type::Kind::Array) {
      element(type, 0, way);
    } else if (type.pou != nullptr) {
      pou(*type.pou, way);
    } else if (way.retain) {
      block(*type.block, way);
    }
  }

 private:
  // Returns whether instances in the type, of a variable that is not retained, have variables that are shared. Blocks
  // in blocks have a million instances: only those with something to find are walked through.
  bool may_share(const Type& type) {
    if (type.kind == Type::Kind::Array) {
      return may_share(*type.element);
    }
    if (type.pou == nullptr) {
      return false;
    }
    const auto known = sharing_.find(type.pou);
    if (known != sharing_.end()) {
      return known->second;
    }
    const auto all = all_variables(*type.pou);
    const bool shares = std::any_of(all.begin(), all.end(), [this](const Variable* one) {
      return is_kept(*one, false) &&
             (one->retain || (holds_instances(*one->type) ? may_share(*one->type) : is_placeless(*one)));
    });
    sharing_[type.pou] = shares;
    return shares;
  }

  // `index`: index of the first element below, row after row.
  void element(const Type& array, std::size_t level, const Way& way, std::uint64_t index = 0) {
    if (level == array.dimensions.size()) {
      Way inner = way;
      const auto given = way.initial != nullptr ? initial_elements(*way.initial, elements_of(array))
                                                : std::vector<const ast::Initial*>();
      inner.initial = index < given.size() ? given[index] : nullptr;
      instances(*array.element, inner);
      return;
    }
    const Bounds& bounds = array.dimensions[level];
    for (std::int64_t i = bounds.low; i <= bounds.high; ++i) {
      Way inner = way;
      inner.cpp += fmt::format("[{}]", i - bounds.low);
      inner.name += i < 0 ? fmt::format("_m{}", -i) : fmt::format("_{}", i);
      element(array, level + 1, inner, index * bounds.count() + static_cast<std::uint64_t>(i - bounds.low));
    }
  }

  void block(const LibraryBlock& block, const Way& way) {
    for (const auto* list : {&block.inputs, &block.outputs}) {
      for (const LibraryParameter& one : *list) {
        Way inner = way;
        inner.cpp += "." + one.cpp;
        inner.name += "_" + one.name;
        inner.initial = initial_text_of(way, one.cpp);
        add(*program_.types.elementary(std::get<Elementary>(one.type)), inner, nullptr);
      }
    }
    use_.restored.push_back(fmt::format("iec::restore({}, scan);", way.cpp));
  }

  void add(const Type& type, const Way& way, const ast::Variable* declared) {
    SharedLocal made;
    made.cpp = way.cpp;
    made.name = way.name;
    const auto placed = program_.placed.find(upper(way.name));
    made.shared_name = placed != program_.placed.end() ? placed->second->shared_name
                                                       : program_.space + "::" + name_of_shared(way.name);
    made.type = &type;
    made.initial = way.initial;
    made.retain = way.retain;
    if (declared != nullptr) {
      const std::string address = declared->address ? ast::to_string(*declared->address) : "";
      made.input = address.starts_with("%I");
      made.comment = address + (address.empty() || declared->comment.empty() ? "" : " ") + declared->comment;
      made.at = declared->at;
    }
    use_.locals.push_back(std::move(made));
  }

  const Program& program_;
  bool show_locals_;
  TaskUse& use_;
  std::map<const Pou*, bool> sharing_;
};

}  // namespace

void find_shared_locals(const Program& program, const TaskPlan& task, bool show_locals, TaskUse& use) {
  Finder finder(program, show_locals, use);
  for (const TaskProgram& one : task.programs) {
    finder.pou(*one.pou, {instance_of(one), one.instance, false, true, nullptr});
  }
  for (const Global& global : program.globals) {
    const bool other = std::none_of(task.programs.begin(), task.programs.end(),
                                    [&](const TaskProgram& one) { return one.pou->instance == &global; });
    if (global.kind == Global::Kind::Private && holds_instances(*global.type) && use.globals.contains(&global) &&
        other) {
      const Pou* pou = global.type->pou;
      const bool is_program = pou != nullptr && pou->tree->kind == ast::Pou::Kind::Program;
      finder.instances(*global.type, {"plc::" + cpp_name(global), is_program ? pou->name : global.name, global.retain,
                                      is_program, global.initial});
    }
  }
}

}  // namespace indurop::plc
