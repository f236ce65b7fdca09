// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/object_emitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "control/plc/emit/cpp_text.h"
#include "control/plc/model/elementary.h"

namespace indurop::plc {
namespace {

using ast::Section;

std::string plc_name(const Pou& pou) {
  return "plc::" + cpp_name(std::string_view(pou.name));
}

bool is_parameter(const Variable& variable) noexcept {
  return variable.section == Section::Input || variable.section == Section::InOut ||
         variable.section == Section::Output;
}

std::string result_of(const Pou& method) {
  return method.result != nullptr ? cpp_type(*method.result) : "void";
}

// Returns whether one of its interfaces requires the method.
bool is_asked_for(const Pou& pou, const Pou& method) {
  return std::any_of(pou.interfaces.begin(), pou.interfaces.end(),
                     [&](const Pou* one) { return find_method(*one, method.name, method.tree->accessor) != nullptr; });
}

// Emits methods that an interface requires and the base has: C++ needs them in this struct.
void forward(const Pou& pou, const Pou& interface, std::set<std::string>& done, TextWriter& out) {
  for (const Pou* one : interface.methods) {
    const Pou* found = pou.base != nullptr ? find_method(*pou.base, one->name, one->tree->accessor) : nullptr;
    const bool own = pou.method_names.contains({one->tree->accessor, upper(one->name)});
    const std::string name = method_name(*one);
    const bool has_code = found != nullptr && found->owner->is_block() && !found->tree->is_abstract;
    if (own || !has_code || !done.insert(name).second) {
      continue;
    }
    std::string arguments;
    for (const Variable& parameter : found->variables) {
      if (is_parameter(parameter)) {
        arguments += (arguments.empty() ? "" : ", ") + cpp_name(std::string_view(parameter.name));
      }
    }
    out.line(fmt::format("{} {}({}) override {{ return {}::{}({}); }}", result_of(*found), name, parameters(*found),
                         plc_name(*pou.base), name, arguments));
  }
}

}  // namespace

std::string method_name(const Pou& method) {
  if (method.name.starts_with('@')) {
    return "method_" + method.name.substr(1);  // those of users are in capitals
  }
  const char* kind = method.tree->accessor == ast::Accessor::None  ? "method_"
                     : method.tree->accessor == ast::Accessor::Get ? "getter_"
                                                                   : "setter_";
  return kind + upper(method.name);
}

std::string kept_name(const Variable& variable) {
  return fmt::format("kept_{}_{}", method_name(*variable.owner), cpp_name(std::string_view(variable.name)));
}

std::string parameters(const Pou& pou) {
  std::string out;
  for (const Variable& one : pou.variables) {
    if (is_parameter(one)) {
      out +=
          fmt::format("{}[[maybe_unused]] {}{} {}", out.empty() ? "" : ", ", cpp_type(*one.type),
                      one.section == Section::Input || one.type->open ? "" : "&", cpp_name(std::string_view(one.name)));
    }
  }
  return out;
}

std::string extends(const Pou& pou) {
  if (!pou.is_object) {
    return "";
  }
  std::string out = pou.base != nullptr ? plc_name(*pou.base) : "iec::Instance";
  for (const Pou* one : pou.interfaces) {
    out += ", virtual " + plc_name(*one);
  }
  return " : " + out;
}

void emit_interface(const Pou& pou, TextWriter& out) {
  const std::string name = cpp_name(std::string_view(pou.name));
  std::string bases;
  for (const Pou* one : pou.interfaces) {
    bases += (bases.empty() ? " : virtual " : ", virtual ") + plc_name(*one);
  }
  out.open("struct " + name + bases);
  out.line(fmt::format("{}() = default;", name));
  out.line(fmt::format("{0}(const {0}&) = default;", name));
  out.line(fmt::format("{0}& operator=(const {0}&) = default;", name));
  out.line(fmt::format("virtual ~{}() = default;", name));
  for (const Pou* method : pou.methods) {
    out.line(fmt::format("virtual {} {}({}) = 0;", result_of(*method), method_name(*method), parameters(*method)));
  }
  out.close(";");
}

void declare_methods(const Pou& pou, TextWriter& out) {
  for (const Pou* method : pou.methods) {
    for (const Variable& one : method->variables) {
      if (one.declared->of_instance && one.global == nullptr) {
        const std::string value = cpp_initial(*one.type, one.declared->initial ? &*one.declared->initial : nullptr);
        out.line(fmt::format("{} {}{};", cpp_type(*one.type), kept_name(one), value == "{}" ? value : " = " + value));
      }
    }
    if (method->name.starts_with('@')) {  // made by the checker, and called where the type is known
      out.line(fmt::format("void {}();", method_name(*method)));
      continue;
    }
    const bool over = method->replaces != nullptr || is_asked_for(pou, *method);
    out.line(fmt::format("{}{} {}({}){}{};", over ? "" : "virtual ", result_of(*method), method_name(*method),
                         parameters(*method), over ? " override" : "", method->tree->is_abstract ? " = 0" : ""));
  }
  std::set<std::string> done;
  std::set<const Pou*> asked;  // each once, even if it is inherited several times
  for (const Pou* one : pou.interfaces) {
    for (const Pou* ancestor : one->ancestors) {
      if (asked.insert(ancestor).second) {
        forward(pou, *ancestor, done, out);
      }
    }
    if (asked.insert(one).second) {
      forward(pou, *one, done, out);
    }
  }
}

}  // namespace indurop::plc
