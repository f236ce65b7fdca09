// SPDX-License-Identifier: Apache-2.0
// Writes the C header of one .glb for modules in C: types with the names of C, constants, and for each variable what
// the macros of <indurop/module_c.h> need. Shared functions and pools are left out.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "glb2idl/emit.h"
#include "glb2idl/emit_types.h"
#include "glb2idl/header_text.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

constexpr std::size_t kSchemaLine = 100;  // bytes of schema text in one line
constexpr std::size_t kBytesInLine = 24;

std::string type_word(const schema::Type& type) {
  constexpr std::array<std::string_view, 12> kNames{"bool",    "char",     "int8_t",  "uint8_t",  "int16_t", "uint16_t",
                                                    "int32_t", "uint32_t", "int64_t", "uint64_t", "float",   "double"};
  if (type.base == Base::Text) {
    return "char";
  }
  return type.name.empty() ? std::string(kNames[static_cast<std::size_t>(type.base)]) : mangled(type.name);
}

// "double name[2][3]"; a text is an array of char.
std::string declared(const schema::Type& type, std::string_view name) {
  std::string out = fmt::format("{} {}", type_word(type), name);
  for (const std::uint32_t dim : type.dims) {
    out += fmt::format("[{}]", dim);
  }
  return type.base == Base::Text ? fmt::format("{}[{}]", out, type.text_size) : out;
}

// The value of a constant with its type, so that an expression has the same type as in C++. Numbers of type int and
// unsigned are plain, for #if.
std::string constant_text(const Constant& constant) {
  if (constant.value.kind == Value::Kind::Text) {
    return fmt::format("\"{}\"", escape(constant.value.text));
  }
  if (!constant.value.enum_type.empty()) {
    return fmt::format("(({}){})", mangled(constant.value.enum_type), to_text(constant.value.integer));
  }
  const Base base = base_of(constant);
  const std::string literal = literal_of(constant);
  const bool is_plain =
      base == Base::Int32 || base == Base::UInt32 || base == Base::Bool || base == Base::Float || base == Base::Double;
  schema::Type type;
  type.base = base;
  return is_plain ? fmt::format("({})", literal) : fmt::format("(({}){})", type_word(type), literal);
}

// Items in the order of the file.
class ItemWriter {
 public:
  ItemWriter(HeaderText& out, const std::string& hash) : out_(out), hash_(hash) {}

  void operator()(const Constant& constant) {
    out_.line("#define {} {}{}", mangled(constant.name), constant_text(constant),
              HeaderText::comment(constant.description));
  }

  void operator()(const Enumeration& enumeration) {
    if (!enumeration.type.name.empty()) {
      out_.line("typedef int32_t {};{}", mangled(enumeration.type.name), HeaderText::comment(enumeration.description));
    }
    std::string values;
    for (const schema::Enumerator& one : enumeration.type.enumerators) {
      values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", mangled(qualified(enumeration.scope, one.name)),
                            one.value);
    }
    out_.line("enum {{ {} }};", values);
  }

  void operator()(const Structure& structure) {
    const schema::Type& type = structure.type;
    const std::string name = mangled(type.name);
    out_.line("typedef struct {} {{{}", name, HeaderText::comment(structure.description));
    for (const schema::Field& field : type.fields) {
      out_.line("  {};{}", declared(field.type, field.name), about(field.description, field.unit));
    }
    out_.line("}} {};", name);
    out_.line("_Static_assert(sizeof({0}) == {1} && _Alignof({0}) == {2}, \"{3}\");", name, type.element_size,
              type.align, type.name);
    for (const schema::Field& field : type.fields) {
      out_.line("_Static_assert(offsetof({}, {}) == {}, \"{}\");", name, field.name, field.offset, field.name);
    }
  }

  void operator()(const Alias& alias) { out_.line("typedef {};", declared(alias.type, mangled(alias.name))); }

  void operator()(const schema::Variable& v) {
    const std::string name = mangled(v.name);
    out_.line("struct irp_value_{} {{ {}; }};{}", name, declared(v.type, "value"), about(v.description, v.unit));
    out_.line("#define irp_hash_{} UINT64_C(0x{:016x})", name, v.name_hash());
    out_.line("#define irp_max_age_ns_{} INT64_C({})", name, v.maxage_ns);
    out_.line("#define irp_ref_{} irp_refs_{}[{}]", name, hash_, index_++);
  }

  void operator()(const schema::Function& /*unused*/) {}
  void operator()(const schema::Pool& /*unused*/) {}

 private:
  HeaderText& out_;
  const std::string& hash_;
  std::size_t index_ = 0;
};

class CWriter {
 public:
  CWriter(const Program& program, const GlbFile& unit)
      : program_(program), unit_(unit), schema_(schema_of(unit)), json_(schema::to_json(schema_)) {}

  std::string write() {
    const std::string guard = fmt::format("INDUROP_{:016x}", hash_of_content());
    const std::string hash = guard.substr(guard.find('_') + 1);
    out_.line("// Shared variables of {}.glb for modules in C, written by glb2idl. Do not edit.", unit_.stem);
    out_.line("#ifndef {}", guard);
    out_.line("#define {}", guard);
    out_.line("");
    out_.line("#include <indurop/module_c.h>");
    for (const std::size_t other : unit_.includes) {
      out_.line("#include \"{}.glb.c.h\"", program_.units[other].stem);
    }
    out_.line("");
    ItemWriter items(out_, hash);
    for (const Item& item : unit_.items) {
      std::visit(items, item);
    }
    if (!schema_.variables.empty()) {
      out_.line("");
      references(hash);
      schema_text(hash);
    }
    out_.line("");
    out_.line("#endif");
    return out_.take();
  }

 private:
  [[nodiscard]] std::uint64_t hash_of_content() const {
    const std::string text = unit_.stem + json_;
    return abi::fnv1a64(text.data(), text.size());
  }

  // One table for each object file that includes the header.
  void references(const std::string& hash) {
    for (const schema::Variable& v : schema_.variables) {
      if (!v.initial.empty()) {
        initial_bytes(v);
      }
    }
    out_.line("static indurop_c_ref irp_refs_{}[] = {{", hash);
    for (const schema::Variable& v : schema_.variables) {
      out_.line("    {{UINT64_C(0x{:016x}), UINT64_C(0x{:016x}), NULL, {}, {}, {}, \"{}\"}},", v.name_hash(),
                v.type_hash, v.initial.empty() ? "NULL" : fmt::format("irp_initial_{}", mangled(v.name)), v.type.size(),
                static_cast<unsigned>(v.kind), v.name);
    }
    out_.line("}};");
    out_.line("__attribute__((constructor(101))) static void irp_bind_{}(void) {{", hash);
    out_.line("  indurop_register_refs(irp_refs_{}, {}, INDUROP_C_ABI);", hash, schema_.variables.size());
    out_.line("}}");
    out_.line("__attribute__((destructor(101))) static void irp_unbind_{}(void) {{", hash);
    out_.line("  indurop_unregister_refs(irp_refs_{});", hash);
    out_.line("}}");
  }

  void initial_bytes(const schema::Variable& v) {
    out_.line("_Alignas(8) static const unsigned char irp_initial_{}[{}] = {{", mangled(v.name), v.initial.size());
    const auto is_used = [](std::uint8_t byte) { return byte != 0; };
    const auto end = std::find_if(v.initial.rbegin(), v.initial.rend(), is_used).base();  // the rest is zero
    for (auto at = v.initial.begin(); at < end;) {
      const auto stop = end - at > static_cast<std::ptrdiff_t>(kBytesInLine) ? at + kBytesInLine : end;
      out_.line("    {},", fmt::join(at, stop, ", "));
      at = stop;
    }
    out_.line("}};");
  }

  // The schema as in the C++ header: one JSON text, not loaded at run time, one copy in each program thanks to comdat.
  void schema_text(const std::string& hash) {
    out_.line("#pragma GCC diagnostic push");
    out_.line("#pragma GCC diagnostic ignored \"-Woverlength-strings\"");
    out_.line("__asm__(\".pushsection .indurop.schema,\\\"G\\\",%progbits,indurop_schema_c_{},comdat\\n\"", hash);
    for (std::size_t at = 0; at < json_.size(); at += kSchemaLine) {
      const std::string line = fmt::format(".ascii \"{}\"", escape(std::string_view(json_).substr(at, kSchemaLine)));
      out_.line("        \"{}\\n\"", escape(line));
    }
    out_.line("        \".ascii \\\"\\\\n\\\"\\n.popsection\");");
    out_.line("#pragma GCC diagnostic pop");
  }

  const Program& program_;
  const GlbFile& unit_;
  schema::Schema schema_;
  std::string json_;
  HeaderText out_;
};

}  // namespace

std::vector<Output> emit_c(const Program& program) {
  std::vector<Output> out;
  std::string all = "// All shared variables for modules in C, written by glb2idl. Do not edit.\n";
  for (const GlbFile& unit : program.units) {
    out.push_back({unit.stem + ".glb.c.h", CWriter(program, unit).write()});
    all += fmt::format("#include \"../{}.glb.c.h\"\n", unit.stem);
  }
  out.push_back({"indurop/generated.c.h", std::move(all)});
  return out;
}

}  // namespace indurop::glb2idl
