// SPDX-License-Identifier: Apache-2.0
// What a program consists of, for programs that show its instances as objects: tasks, programs, their types, and where
// the value of each variable is in the watched data.
#include <fmt/format.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "control/plc/emit/instance_types.h"
#include "tools/client/plc/plc_view.h"

namespace indurop::tools {
namespace {

using plc::Elementary;
using plc::InstanceVariable;
using plc::Type;

const char* kind_of(Elementary type) {
  switch (type) {
    case Elementary::Bool:
      return "bool";
    case Elementary::Sint:
      return "i8";
    case Elementary::Byte:
    case Elementary::Usint:
    case Elementary::Char:
      return "u8";
    case Elementary::Int:
      return "i16";
    case Elementary::Word:
    case Elementary::Uint:
    case Elementary::Wchar:
      return "u16";
    case Elementary::Dint:
      return "i32";
    case Elementary::Dword:
    case Elementary::Udint:
      return "u32";
    case Elementary::Lword:
    case Elementary::Ulint:
      return "u64";
    case Elementary::Real:
      return "f32";
    case Elementary::Lreal:
      return "f64";
    case Elementary::String:
      return "text";
    case Elementary::Wstring:
      return "wide_text";
    case Elementary::Lint:
    case Elementary::Time:
    case Elementary::Date:
    case Elementary::TimeOfDay:
    case Elementary::DateAndTime:
      break;
  }
  return "i64";
}

const char* section_of(plc::ast::Section section) {
  using plc::ast::Section;
  switch (section) {
    case Section::Input:
      return "input";
    case Section::Output:
      return "output";
    case Section::InOut:
      return "in_out";
    case Section::External:
    case Section::Global:
      return "external";
    case Section::Local:
    case Section::Temp:
      break;
  }
  return "local";
}

class Model {
 public:
  Model(const plc::WatchPlan& plan, const plc::InstanceTypes& found) : plan_(plan), found_(found) {}

  JsonValue tasks() const {
    JsonValue out = JsonValue::array();
    for (std::size_t i = 0; i < plan_.program->tasks.size(); ++i) {
      JsonValue one = JsonValue::object();
      one["name"] = plan_.program->tasks[i].name;
      one["module"] = plan_.modules[i];
      if (const plc::Global* single = plan_.program->tasks[i].single) {
        one["single"] = single->shared_name;
      }
      out.push_back(std::move(one));
    }
    return out;
  }

  JsonValue instances() const {
    JsonValue out = JsonValue::array();
    std::size_t next = 0;
    for (std::size_t task = 0; task < plan_.program->tasks.size(); ++task) {
      for (const plc::TaskProgram& program : plan_.program->tasks[task].programs) {
        const plc::WatchLayout& layout = plan_.layouts[next];
        JsonValue one = JsonValue::object();
        one["name"] = program.instance;
        one["task"] = task;
        one["type"] = found_.programs[next++];
        one["variable"] = plan_.space + "::" + layout.variable;
        one["mark"] = fmt::format("{:016x}", layout.mark);
        one["offset"] = plc::kInstanceBegin;
        out.push_back(std::move(one));
      }
    }
    return out;
  }

  JsonValue types() const {
    JsonValue out = JsonValue::array();
    for (const plc::InstanceType& type : found_.types) {
      JsonValue one = JsonValue::object();
      one["name"] = type.name;
      one["kind"] = type.pou == nullptr                                    ? "library"
                    : type.pou->tree->kind == plc::ast::Pou::Kind::Program ? "program"
                                                                           : "block";
      if (type.base != plc::kNoType) {
        one["base"] = type.base;
      }
      one["size"] = type.bytes;
      JsonValue variables = JsonValue::array();
      for (const InstanceVariable& variable : type.variables) {
        variables.push_back(variable_of(variable));
      }
      one["variables"] = std::move(variables);
      out.push_back(std::move(one));
    }
    return out;
  }

  // Shared variables that the program declares.
  JsonValue globals() const {
    JsonValue out = JsonValue::array();
    for (const plc::Global& global : plan_.program->globals) {
      if (global.kind == plc::Global::Kind::Own && !global.shared_name.empty()) {
        out.push_back(global.shared_name);
      }
    }
    return out;
  }

 private:
  JsonValue variable_of(const InstanceVariable& variable) const {
    JsonValue out = JsonValue::object();
    out["name"] = variable.name;
    out["section"] = section_of(variable.section);
    if (variable.global != nullptr && !variable.global->shared_name.empty()) {
      out["variable"] = variable.global->shared_name;
    }
    if (variable.offset) {
      out["offset"] = *variable.offset;
    }
    out["type"] = form_of(*variable.type, variable.of);
    if (variable.step) {
      out["step"] = true;
    }
    if (variable.variable != nullptr) {
      add_words(*variable.variable, out);
    }
    return out;
  }

  static void add_words(const plc::Variable& variable, JsonValue& out) {
    const plc::ast::Variable& declared = *variable.declared;
    if (variable.is_constant) {
      out["constant"] = true;
    }
    if (declared.retain) {
      out["retain"] = true;
    }
    if (declared.non_retain) {
      out["non_retain"] = true;
    }
    if (variable.global != nullptr && !variable.global->address.empty()) {
      out["at"] = variable.global->address;
    }
    if (!declared.comment.empty()) {
      out["description"] = declared.comment;
    }
  }

  // With the offsets of the watched data, which has no gaps.
  JsonValue form_of(const Type& type, std::size_t instance = plc::kNoType) const {
    const Type* inner = &type;
    JsonValue dims = JsonValue::array();
    JsonValue low = JsonValue::array();
    for (; inner->kind == Type::Kind::Array; inner = inner->element) {
      for (const plc::Bounds& one : inner->dimensions) {
        dims.push_back(one.count());
        low.push_back(one.low);
      }
    }
    JsonValue out = element_of(*inner, instance);
    if (type.kind == Type::Kind::Array) {
      out["dims"] = std::move(dims);
      out["low"] = std::move(low);
    }
    return out;
  }

  JsonValue element_of(const Type& type, std::size_t instance) const {
    JsonValue out = JsonValue::object();
    switch (type.kind) {
      case Type::Kind::Elementary:
        out["kind"] = kind_of(type.elementary);
        out["iec"] = plc::name_of(type.elementary);
        if (type.range) {
          out["range"] = {{"min", type.range->low}, {"max", type.range->high}};
        }
        break;
      case Type::Kind::Enum:
        out["kind"] = "enum";
        out["name"] = name_of(type);
        out["unsigned"] = !plc::is_signed_int(type.elementary);
        out["enumerators"] = enumerators_of(type);
        break;
      case Type::Kind::Struct:
        out["kind"] = "struct";
        out["name"] = name_of(type);
        out["fields"] = fields_of(type);
        break;
      case Type::Kind::Block:
        out["kind"] = "instance";
        if (instance != plc::kNoType) {
          out["instance"] = instance;
          out["size"] = found_.types[instance].bytes;
          return out;
        }
        break;
      case Type::Kind::Array:
      case Type::Kind::Pointer:
      case Type::Kind::Interface:
        out["kind"] = "reference";
        break;
    }
    out["size"] = plc::packed_size(type);
    return out;
  }

  JsonValue fields_of(const Type& type) const {
    JsonValue out = JsonValue::array();
    std::size_t offset = 0;
    for (const plc::Field& field : type.fields) {
      JsonValue one = JsonValue::object();
      one["name"] = field.name;
      one["offset"] = offset;
      one["type"] = form_of(*field.type);
      if (!field.comment.empty()) {
        one["description"] = field.comment;
      }
      offset += plc::packed_size(*field.type);
      out.push_back(std::move(one));
    }
    return out;
  }

  static JsonValue enumerators_of(const Type& type) {
    JsonValue out = JsonValue::object();
    for (const plc::EnumItem& item : type.items) {
      out[item.name] = item.value;
    }
    return out;
  }

  std::string name_of(const Type& type) const {
    return type.shared_name.empty() ? plan_.space + "::" + type.name : type.shared_name;
  }

  const plc::WatchPlan& plan_;
  const plc::InstanceTypes& found_;
};

}  // namespace

JsonValue PlcView::model() const {
  const plc::InstanceTypes found = plc::instance_types(plan_.instances);
  const Model model(plan_, found);
  JsonValue out = JsonValue::object();
  out["namespace"] = plan_.space;
  out["tasks"] = model.tasks();
  out["instances"] = model.instances();
  out["types"] = model.types();
  out["globals"] = model.globals();
  return out;
}

}  // namespace indurop::tools
