// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/glb_emitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "control/plc/check/shared_names.h"
#include "control/plc/check/value_tree.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/task_use.h"
#include "control/plc/emit/watch_layout.h"
#include "control/plc/model/characters.h"
#include "core/base/utf8.h"

namespace indurop::plc {
namespace {

constexpr std::array<std::string_view, kElementaryCount> kGlbTypes{
    "bool",    "uint8_t", "uint16_t", "uint32_t", "uint64_t", "int8_t",  "int16_t", "int32_t",
    "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t", "float",   "double",  "int64_t",
    "int64_t", "int64_t", "int64_t",  "char",     "uint16_t", "uint8_t", "uint16_t"};

std::string glb_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else {
      out += byte < 0x20 || byte == 0x7F ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    }
  }
  return out + '"';
}

std::string glb_constant(const Constant& value) {
  if (const auto* flag = std::get_if<bool>(&value)) {
    return *flag ? "true" : "false";
  }
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? glb_text(*text) : to_string(value);
}

std::uint64_t count_of(const Type& array, std::size_t level) noexcept {
  return array.dimensions[level].count();
}

// Returns whether values count from 0 without gaps, as .glb requires.
bool is_glb_enum(const Type& type) noexcept {
  std::int64_t next = 0;
  return std::all_of(type.items.begin(), type.items.end(), [&](const EnumItem& one) { return one.value == next++; });
}

class GlbEmitter {
 public:
  GlbEmitter(const Program& program, const std::string& sources) : program_(program) {
    line("// Written by indurop plc from " + comment_text(sources) + ": change that, not this.");
    line(fmt::format("namespace {};", program.space));
    for (const Global& global : program.globals) {
      if (global.kind == Global::Kind::Own) {
        taken_.insert(upper(last_name(global.shared_name)));
      }
    }
  }

  GlbFile run(bool show_locals, bool watch) {
    for (const Global& global : program_.globals) {
      if (global.kind == Global::Kind::Own) {
        need(*global.type);
        std::string comment = global.address;
        comment += comment.empty() || global.comment.empty() ? "" : " ";
        variable(std::string(last_name(global.shared_name)), *global.type, global.initial, global.retain,
                 comment + global.comment, global.at);
      }
    }
    for (const TaskPlan& task : program_.tasks) {
      const TaskUse use = use_of(program_, task, show_locals);
      for (const SharedLocal& one : use.locals) {
        if (program_.placed.contains(upper(one.name))) {
          continue;  // VAR_CONFIG gives it the address of a global
        }
        need(*one.type);
        variable(std::string(last_name(one.shared_name)), *one.type, one.initial, one.retain, one.comment, one.at);
      }
      for (const SharedAccess& one : use.accesses) {
        const AccessPath& path = *one.path;
        const bool own = path.to.steps.size() == 1 && path.to.steps.front().variable != nullptr;
        const auto* declared = own ? path.to.steps.front().variable->declared : nullptr;
        need(*path.type);
        variable(std::string(last_name(one.shared_name)), *path.type,
                 declared != nullptr && declared->initial ? &*declared->initial : nullptr, false,
                 path.writable ? "VAR_ACCESS" : "VAR_ACCESS, read only", path.at);
      }
      for (std::size_t i = 0; watch && i < task.programs.size(); ++i) {
        const WatchLayout layout = watch_layout(task.programs[i]);
        line(fmt::format("uint8_t {}[{}] @view;  // of {}, for indurop plc watch", layout.variable, layout.bytes,
                         task.programs[i].instance),
             task.programs[i].pou->tree->at);
      }
    }
    return std::move(out_);
  }

 private:
  void line(const std::string& text, const Place& at = {}) {
    out_.text += text + "\n";
    out_.places.push_back(at);
  }

  // Declares types before their first use.
  void need(const Type& type) {
    if (type.kind == Type::Kind::Array) {
      need(*type.element);
      return;
    }
    const bool own = type.shared_name.empty() && !type.name.empty();
    if (!own || (type.kind != Type::Kind::Struct && type.kind != Type::Kind::Enum) || !declared_.insert(&type).second) {
      return;
    }
    if (type.kind == Type::Kind::Enum) {
      enumeration(type);
      return;
    }
    for (const Field& field : type.fields) {
      need(*field.type);
    }
    line(fmt::format("struct {} {{", type.glb_name));
    for (const Field& field : type.fields) {
      line("  " + declarator(*field.type, field.member()) + ";" + description(field.comment));
    }
    line("};");
  }

  void enumeration(const Type& type) {
    const bool free = std::none_of(type.items.begin(), type.items.end(),
                                   [&](const EnumItem& one) { return taken_.contains(upper(one.shared)); });
    if (!is_glb_enum(type) || !free) {
      return;  // shown as a number
    }
    enums_.insert(&type);
    std::string items;
    for (const EnumItem& one : type.items) {
      taken_.insert(upper(one.shared));
      items += (items.empty() ? "" : ", ") + one.shared;
    }
    line(fmt::format("enum {} {{ {} }};", type.glb_name, items));
  }

  std::string declarator(const Type& type, const std::string& name) {
    std::string dims;
    const Type* inner = &type;
    for (; inner->kind == Type::Kind::Array; inner = inner->element) {
      for (const Bounds& one : inner->dimensions) {
        dims += fmt::format("[{}]", one.count());
      }
    }
    if (inner->is_text()) {
      dims += fmt::format("[{}]", inner->length + 1);
    }
    const std::string unit = inner->is(Elementary::Time) ? " @unit(\"ns\")" : "";
    return fmt::format("{} {}{}{}", type_name(*inner), name, dims, unit);
  }

  std::string type_name(const Type& type) {
    if (!type.shared_name.empty()) {
      return type.shared_name;
    }
    if (type.kind == Type::Kind::Struct || enums_.contains(&type)) {
      return type.glb_name;
    }
    return std::string(kGlbTypes[static_cast<std::size_t>(type.elementary)]);
  }

  void variable(const std::string& name, const Type& type, const ast::Initial* initial, bool retain,
                const std::string& comment, const Place& at) {
    const ValueTree tree = initial_value(type, initial);
    std::string text = declarator(type, name) + (retain ? " @retain" : "");
    if (!tree.zero) {
      text += " = " + value(type, tree, 0);
    }
    line(text + ";" + description(comment), at);
  }

  std::string value(const Type& type, const ValueTree& tree, std::size_t level) {
    if (type.kind == Type::Kind::Enum && enums_.contains(&type)) {
      return type.items[static_cast<std::size_t>(*as_int64(tree.value))].shared;
    }
    if (type.is(Elementary::Wstring)) {
      return tree.zero ? "{}" : wide_text(std::get<std::string>(tree.value));
    }
    if (type.kind == Type::Kind::Elementary || type.kind == Type::Kind::Enum) {
      return tree.zero && type.is_text() ? "\"\"" : tree.zero ? "0" : glb_constant(tree.value);
    }
    std::string parts;
    const std::size_t count = tree.equal_parts ? count_of(type, level) : tree.parts.size();
    for (std::size_t i = 0; i < count; ++i) {
      const ValueTree& part = tree.parts[tree.equal_parts ? 0 : i];
      const bool deeper = type.kind == Type::Kind::Array && level + 1 < type.dimensions.size();
      const Type& inner = type.kind == Type::Kind::Struct ? *type.fields[i].type : deeper ? type : *type.element;
      parts += (i > 0 ? ", " : "") +
               (part.zero && inner.kind > Type::Kind::Enum ? "{}" : value(inner, part, deeper ? level + 1 : 0));
    }
    return "{" + parts + "}";
  }

  // Returns its characters as numbers, up to the end of the array.
  static std::string wide_text(std::string_view utf8) {
    std::string parts;
    for (const char16_t one : to_wide(utf8)) {
      parts += fmt::format("{}{}", parts.empty() ? "" : ", ", static_cast<unsigned>(one));
    }
    return "{" + parts + "}";
  }

  static std::string description(std::string text) {
    text = comment_text(text);
    std::erase(text, '\\');
    if (base::first_invalid_utf8(text)) {
      return "";  // in another code, as some editors write it
    }
    return text.empty() ? "" : "  // " + text;
  }

  const Program& program_;
  GlbFile out_;
  std::set<const Type*> declared_;
  std::set<const Type*> enums_;
  std::set<std::string> taken_;  // names in the namespace, in capitals
};

}  // namespace

GlbFile emit_glb(const Program& program, const std::string& sources, bool show_locals, bool watch) {
  return GlbEmitter(program, sources).run(show_locals, watch);
}

}  // namespace indurop::plc
