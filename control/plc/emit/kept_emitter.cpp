// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/kept_emitter.h"

#include <fmt/format.h>

#include <indurop/detail/abi.h>
#include <indurop/state.h>

#include <algorithm>

#include "control/plc/check/value_tree.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/object_emitter.h"
#include "control/plc/library/signature.h"
#include "control/plc/lower/flow.h"

namespace indurop::plc {
namespace {

using ast::Section;

std::string name_in_cpp(const Variable& variable) {
  return cpp_name(std::string_view(variable.name));
}

// Elements of an array that holds addresses are listed one by one.
constexpr std::uint64_t kMaxElements = 1000;

// Returns whether it is a member of each instance. What a VAR_IN_OUT leads to is set by each call.
bool is_kept_in_instance(const Variable& variable) noexcept {
  return variable.section != Section::External && variable.global == nullptr && variable.section != Section::Temp &&
         variable.section != Section::InOut && !variable.declared->is_static &&
         !(variable.is_constant && variable.section == Section::Local);
}

// Returns whether it is a VAR_IN_OUT that methods use between two calls of its instance.
bool is_kept_in_out(const Variable& variable) noexcept {
  return variable.section == Section::InOut && variable.in_methods;
}

bool holds_addresses(const Type& type) {
  switch (type.kind) {
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      return true;
    case Type::Kind::Array:
      return holds_addresses(*type.element);
    case Type::Kind::Struct:
      return std::any_of(type.fields.begin(), type.fields.end(),
                         [](const Field& one) { return holds_addresses(*one.type); });
    case Type::Kind::Block: {
      if (type.pou == nullptr) {
        return false;
      }
      const auto all = all_variables(*type.pou);
      return type.pou->is_object || std::any_of(all.begin(), all.end(), [](const Variable* one) {
               return one->section == Section::InOut || (is_kept_in_instance(*one) && holds_addresses(*one->type));
             });
    }
    default:
      return false;
  }
}

// Adds all that decides about the bytes of a value.
void describe(const Type& type, std::string& layout);

void describe(const Pou& pou, std::string& layout) {
  layout += "BLOCK{";
  for (const Variable* one : all_variables(pou)) {
    if (is_kept_in_instance(*one)) {
      layout += one->name + ":";
      describe(*one->type, layout);
      layout += one->declared->edge != ast::Edge::None ? ",edge;" : ";";
    }
  }
  layout += "}";
}

void describe(const Type& type, std::string& layout) {
  switch (type.kind) {
    case Type::Kind::Array:
      for (const Bounds& bounds : type.dimensions) {
        layout += fmt::format("[{}..{}]", bounds.low, bounds.high);
      }
      return describe(*type.element, layout);
    case Type::Kind::Struct:
      layout += type.overlaps ? "UNION{" : "STRUCT{";
      for (const Field& field : type.fields) {
        layout += field.name + ":";
        describe(*field.type, layout);
        layout += ";";
      }
      layout += "}";
      return;
    case Type::Kind::Block:
      if (type.pou != nullptr) {
        return describe(*type.pou, layout);
      }
      [[fallthrough]];
    default:
      layout += to_string(type);
  }
}

// Returns the name of the type, and a hash where it has several parts: what has the same text has the same bytes. The
// text of an array ends with that of an element, so that its length can be compared with another one.
std::string type_text(const Type& type) {
  const std::string title = to_string(type);
  if (type.kind == Type::Kind::Array && title.ends_with(to_string(*type.element))) {
    return title.substr(0, title.size() - to_string(*type.element).size()) + type_text(*type.element);
  }
  std::string layout;
  describe(type, layout);
  return layout == title ? title : fmt::format("{} #{:016x}", title, abi::fnv1a64(layout.data(), layout.size()));
}

class KeptEmitter {
 public:
  KeptEmitter(const TaskPlan& task, const TaskUse& use, TextWriter& out) : task_(task), use_(use), out_(out) {}

  void collect(const std::vector<const Global*>& globals, const std::vector<std::string>& own) {
    for (const std::string& name : own) {
      add(name, "BOOL", name);
    }
    for (const Global* global : globals) {
      if (global->kind == Global::Kind::Private) {
        collect(global->name, "plc::" + cpp_name(*global), *global->type);
      } else if (in_image(*global)) {
        place(global->name, "shared." + cpp_name(*global), *global->type);
      }
    }
    for (const TaskProgram& one : task_.programs) {
      if (one.pou->instance == nullptr) {
        collect(one.instance, instance_of(one), *one.pou);
      }
    }
    for (const Pou* pou : use_.pous) {
      collect_static(*pou);
    }
    if (std::any_of(use_.pous.begin(), use_.pous.end(), [](const Pou* one) { return one->points_to_own; })) {
      add("calls", "UDINT", "iec::Lifetime::last_number()");
    }
  }

  void emit() {
    if (has_addresses_) {
      items_.insert(items_.end(), places_.begin(), places_.end());
    }
    out_.line("// What it keeps between its scans.");
    out_.open("extern \"C\" void indurop_module_state(indurop::StateDescriptor* to)");
    out_.line(fmt::format("static constexpr std::array<indurop::StateItem, {}> items{{", items_.size()));
    for (const std::string& item : items_) {
      out_.line("    " + item);
    }
    out_.line("};");
    out_.line(fmt::format("iec::declare_kept(items, {}, to);", missing_.empty() ? "nullptr" : quote(missing_)));
    out_.close();
    out_.line();
    if (!missing_.empty()) {  // for tools that inspect a module file
      out_.raw("asm(R\"indurop(.pushsection .indurop.undeclarable,\"\",%progbits\n");
      out_.raw(fmt::format(".ascii {}\n.popsection)indurop\");\n", quote(missing_)));
    }
  }

 private:
  void add(const std::string& name, const std::string& type, const std::string& cpp) {
    items_.push_back(fmt::format("iec::kept({}, {}, {}),", quote(name), quote(type), cpp));
  }

  void address(const std::string& name, const Type& type, const std::string& cpp) {
    has_addresses_ = true;
    add(name, std::string(kStateAddress) + to_string(type), cpp);
  }

  // What is in several parts, or not kept, can be led to as a whole.
  void place(const std::string& name, const std::string& cpp, const Type& type) {
    places_.push_back(fmt::format("iec::kept_place({}, {}, {}),", quote(name),
                                  quote(std::string(kStatePlace) + type_text(type)), cpp));
  }

  void miss(const std::string& name, const std::string& why) {
    missing_ += (missing_.empty() ? "" : ", ") + name + " (" + why + ")";
  }

  void collect(const std::string& name, const std::string& cpp, const Pou& pou) {
    for (const Variable* one : all_variables(pou)) {
      const std::string place = cpp + "." + name_in_cpp(*one);
      if (lower::is_flow(one->name)) {
        add(name + "." + one->name, std::string(kStateShown) + type_text(*one->type), place);
      } else if (is_kept_in_instance(*one)) {
        collect(name + "." + one->name, place, *one->type);
      } else if (is_kept_in_out(*one) && one->type->open) {
        miss(name + "." + one->name, "an array of any length that methods use");
      } else if (is_kept_in_out(*one)) {
        address(name + "." + one->name, *one->type, place);
      }
      if (one->declared->edge != ast::Edge::None) {
        add(name + "." + one->name + ", before", "BOOL", place + "_before");
      }
    }
    for (const Pou* of = &pou; of != nullptr; of = of->base) {
      collect_of_methods(name, cpp, *of);
    }
  }

  void collect_of_methods(const std::string& name, const std::string& cpp, const Pou& pou) {
    for (const Pou* method : pou.methods) {
      for (const Variable& one : method->variables) {
        if (one.declared->of_instance && one.global == nullptr) {
          collect(name + "." + method->title() + "." + one.name,
                  cpp + ".plc::" + cpp_name(std::string_view(pou.name)) + "::" + kept_name(one), *one.type);
        }
      }
    }
  }

  // An instance is taken by its variables, so that another version of it gets those of the same name.
  void collect(const std::string& name, const std::string& cpp, const Type& type) {
    const bool in_parts = holds_addresses(type);
    if (type.kind == Type::Kind::Block && type.pou != nullptr) {
      place(name, cpp, type);
      collect(name, cpp, *type.pou);
    } else if (type.kind == Type::Kind::Pointer || type.kind == Type::Kind::Interface) {
      address(name, type, cpp);
    } else if (type.kind == Type::Kind::Struct && in_parts) {
      place(name, cpp, type);
      for (const Field& field : type.fields) {
        collect(name + "." + field.name, cpp + "." + field.member(), *field.type);
      }
    } else if (type.kind == Type::Kind::Array && in_parts && elements_of(type) > kMaxElements) {
      miss(name, fmt::format("an array of more than {} addresses", kMaxElements));
    } else if (type.kind == Type::Kind::Array && in_parts) {
      place(name, cpp, type);
      collect_elements(name, cpp, type, 0, "");
    } else {
      add(name, type_text(type), cpp);
    }
  }

  void collect_elements(const std::string& name, const std::string& cpp, const Type& array, std::size_t dimension,
                        const std::string& indices) {
    if (dimension == array.dimensions.size()) {
      return collect(name + "[" + indices + "]", cpp, *array.element);
    }
    const Bounds& bounds = array.dimensions[dimension];
    for (std::int64_t i = bounds.low; i <= bounds.high; ++i) {
      collect_elements(name, fmt::format("{}[{}]", cpp, i - bounds.low), array, dimension + 1,
                       indices + (indices.empty() ? "" : ",") + std::to_string(i));
    }
  }

  void collect_static(const Pou& pou) {
    for (const Variable& one : pou.variables) {
      if (!one.declared->is_static || one.is_constant || one.global != nullptr) {
        continue;
      }
      const std::string name = pou.title() + "." + one.name;
      if (pou.is_callable()) {
        miss(name, "VAR_STAT of a function or method");
      } else {
        collect(name, "plc::" + cpp_name(std::string_view(pou.name)) + "::" + name_in_cpp(one), *one.type);
      }
    }
  }

  const TaskPlan& task_;
  const TaskUse& use_;
  TextWriter& out_;
  std::vector<std::string> items_;
  std::vector<std::string> places_;
  bool has_addresses_ = false;
  std::string missing_;
};

}  // namespace

void emit_kept(const TaskPlan& task, const TaskUse& use, const std::vector<const Global*>& globals,
               const std::vector<std::string>& own, TextWriter& out) {
  KeptEmitter emitter(task, use, out);
  emitter.collect(globals, own);
  emitter.emit();
}

}  // namespace indurop::plc
