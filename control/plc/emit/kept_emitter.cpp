// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/kept_emitter.h"

#include <fmt/format.h>

#include <indurop/detail/abi.h>

#include <algorithm>

#include "control/plc/emit/cpp_text.h"
#include "control/plc/library/signature.h"

namespace indurop::plc {
namespace {

using ast::Section;

std::string name_in_cpp(const Variable& variable) {
  return cpp_name(std::string_view(variable.name));
}

// Returns whether it is a member of each instance. What a VAR_IN_OUT leads to is set by each call.
bool is_kept_in_instance(const Variable& variable) noexcept {
  return variable.section != Section::External && variable.global == nullptr && variable.section != Section::Temp &&
         variable.section != Section::InOut && !variable.declared->is_static &&
         !(variable.is_constant && variable.section == Section::Local);
}

bool has_in_outs(const Pou& pou) noexcept {
  return std::any_of(pou.variables.begin(), pou.variables.end(),
                     [](const Variable& one) { return one.section == Section::InOut; });
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
  }

  void emit() {
    out_.line("// What it keeps between its scans.");
    out_.open("extern \"C\" void indurop_module_state(indurop::StateDescriptor* to)");
    out_.line(fmt::format("static constexpr std::array<indurop::StateItem, {}> items{{", items_.size()));
    for (const std::string& item : items_) {
      out_.line("    " + item);
    }
    out_.line("};");
    out_.line(fmt::format("iec::declare_kept(items, {}, to);", missing_.empty() ? "nullptr" : quoted(missing_)));
    out_.close();
    out_.line();
  }

 private:
  void add(const std::string& name, const std::string& type, const std::string& cpp) {
    items_.push_back(fmt::format("iec::kept({}, {}, {}),", quoted(name), quoted(type), cpp));
  }

  void miss(const std::string& name, const std::string& why) {
    missing_ += (missing_.empty() ? "" : ", ") + name + " (" + why + ")";
  }

  void collect(const std::string& name, const std::string& cpp, const Pou& pou) {
    if (pou.is_object) {
      return miss(name, "a function block with methods");
    }
    for (const Variable& one : pou.variables) {
      const std::string place = cpp + "." + name_in_cpp(one);
      if (is_kept_in_instance(one)) {
        collect(name + "." + one.name, place, *one.type);
      }
      if (one.declared->edge != ast::Edge::None) {
        add(name + "." + one.name + ", before", "BOOL", place + "_before");
      }
    }
  }

  // An instance is taken by its variables, so that another version of it gets those of the same name.
  void collect(const std::string& name, const std::string& cpp, const Type& type) {
    if (type.kind == Type::Kind::Block && type.pou != nullptr) {
      return collect(name, cpp, *type.pou);
    }
    std::string layout;
    if (const std::string why = describe(type, layout); !why.empty()) {
      return miss(name, why);
    }
    const std::string title = to_string(type);
    add(name, layout == title ? title : fmt::format("{} #{:016x}", title, abi::fnv1a64(layout.data(), layout.size())),
        cpp);
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

  // Adds all that decides about the bytes of a value. Returns why they cannot be taken; empty: they can.
  static std::string describe(const Type& type, std::string& layout) {
    switch (type.kind) {
      case Type::Kind::Pointer:
      case Type::Kind::Interface:
        return "it leads to another variable";
      case Type::Kind::Array:
        for (const Bounds& bounds : type.dimensions) {
          layout += fmt::format("[{}..{}]", bounds.low, bounds.high);
        }
        return describe(*type.element, layout);
      case Type::Kind::Struct:
        layout += type.overlaps ? "UNION{" : "STRUCT{";
        for (const Field& field : type.fields) {
          layout += field.name + ":";
          if (std::string why = describe(*field.type, layout); !why.empty()) {
            return why;
          }
          layout += ";";
        }
        layout += "}";
        return "";
      case Type::Kind::Block:
        return type.pou != nullptr ? describe(*type.pou, layout) : (layout += to_string(type), "");
      default:
        layout += to_string(type);
        return "";
    }
  }

  static std::string describe(const Pou& pou, std::string& layout) {
    if (pou.is_object || has_in_outs(pou)) {
      return pou.is_object ? "function blocks with methods" : "an array of function blocks with VAR_IN_OUT";
    }
    layout += "BLOCK{";
    for (const Variable& one : pou.variables) {
      if (is_kept_in_instance(one)) {
        layout += one.name + ":";
        if (std::string why = describe(*one.type, layout); !why.empty()) {
          return why;
        }
        layout += one.declared->edge != ast::Edge::None ? ",edge;" : ";";
      }
    }
    layout += "}";
    return "";
  }

  const TaskPlan& task_;
  const TaskUse& use_;
  TextWriter& out_;
  std::vector<std::string> items_;
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
