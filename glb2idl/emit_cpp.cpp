// SPDX-License-Identifier: Apache-2.0
// Writes the C++ header of one .glb: value types, then the hidden part (table of references, shapes), then the
// variables.

#include <fmt/format.h>

#include <algorithm>

#include "glb2idl/emit.h"
#include "glb2idl/emit_types.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

constexpr std::size_t kLine = 100;  // bytes of schema text in one line

// The class of a number. The code of PLC programs needs less of it and chooses another one, because each costs g++
// time.
constexpr std::string_view kLeaf = "::indurop::Leaf";
constexpr std::string_view kChosenLeaf = "INDUROP_LEAF";

// Names that end with a hash of the text that contains them; the hash is filled in when the text is complete.
constexpr std::string_view kHidden = "indurop_generated_";
constexpr std::string_view kHiddenSchema = "indurop_schema_";
constexpr std::string_view kNoHash = "0000000000000000";

void set_hash(std::string& text, const std::string& name, const std::string& hash) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + name.size())) {
    text.replace(at + name.size() - hash.size(), hash.size(), hash);
  }
}

std::string hex(std::uint64_t value) {
  return fmt::format("0x{:016x}", value);
}

template <class T>
std::vector<const T*> all_of(const GlbFile& unit) {
  std::vector<const T*> out;
  for (const Item& item : unit.items) {
    if (const auto* found = std::get_if<T>(&item)) {
      out.push_back(found);
    }
  }
  return out;
}

class CppWriter {
 public:
  CppWriter(const Program& program, std::size_t unit, const std::vector<std::string>& hidden)
      : program_(program),
        unit_(program.units[unit]),
        hidden_names_(hidden),
        hidden_(hidden[unit]),
        variables_(all_of<schema::Variable>(unit_)),
        functions_(all_of<schema::Function>(unit_)),
        pools_(all_of<schema::Pool>(unit_)) {}

  std::string run() {
    head();
    emit_types(unit_, out_);
    out_.enter("");
    hidden_part();
    objects();
    return out_.take();
  }

 private:
  void head() {
    out_.line("// Shared variables of {}.glb, written by glb2idl. Do not edit.", unit_.stem);
    out_.line("#pragma once");
    out_.line("");
    out_.line("#include <indurop/lock.h>");
    out_.line("#include <indurop/var.h>");
    if (!functions_.empty()) {
      out_.line("#include <indurop/function.h>");
    }
    if (!pools_.empty()) {
      out_.line("#include <indurop/pool.h>");
    }
    out_.line("");
    out_.line("#include <array>");
    out_.line("#include <cstddef>");
    out_.line("#include <cstdint>");
    out_.line("");
    out_.line("#ifndef {}", kChosenLeaf);
    out_.line("#define {} {}", kChosenLeaf, kLeaf);
    out_.line("#endif");
    for (const std::size_t other : unit_.includes) {
      out_.line("");
      out_.line("#include \"{}.glb.h\"", program_.units[other].stem);
    }
    if (!variables_.empty() || !functions_.empty() || !pools_.empty()) {
      schema_text();
    }
  }

  // The schema: one JSON text, not loaded at run time, one copy per object file and program thanks to comdat.
  void schema_text() {
    const std::string json = schema::to_json(schema_of(unit_));
    out_.line("");
    out_.line("asm(R\"indurop(.pushsection .indurop.schema,\"G\",%progbits,{}{},comdat", kHiddenSchema, kNoHash);
    for (std::size_t at = 0; at < json.size(); at += kLine) {
      out_.line(".ascii \"{}\"", escape(std::string_view(json).substr(at, kLine)));
    }
    out_.line(".ascii \"\\n\"");
    out_.line(".popsection)indurop\");");
  }

  // ---- the hidden part

  void hidden_part() {
    out_.line("");
    out_.line("namespace {} __attribute__((visibility(\"hidden\"))) {{", hidden_);
    if (!variables_.empty()) {
      references();
    }
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      tag(*variables_[i], i);
    }
    for (const Structure* structure : all_of<Structure>(unit_)) {
      shape_union(structure->type);
    }
    for (const schema::Function* function : functions_) {
      function_tag(*function);
    }
    for (const schema::Pool* pool : pools_) {
      pool_tag(*pool);
    }
    out_.line("}}  // namespace {}", hidden_);
  }

  void references() {
    for (const schema::Variable* v : variables_) {
      if (!v->initial.empty()) {
        out_.line("inline constexpr {} initial_{}{{{}}};", cpp_type(v->type), mangled(v->name), initial_value(*v));
      }
    }
    out_.line("inline constinit ::indurop::abi::Ref refs[] = {{");
    for (const schema::Variable* v : variables_) {
      out_.line("    {{{}, {}, nullptr, {}, {}, ::indurop::abi::Kind::{}, \"{}\"}},", hex(v->name_hash()),
                hex(v->type_hash), v->initial.empty() ? "nullptr" : fmt::format("&initial_{}", mangled(v->name)),
                v->type.size(), kind(*v), v->name);
    }
    out_.line("}};");
    // Each object file of a module has this constructor; the table is registered only once.
    out_.line("inline constinit ::std::uint32_t users = 0;");
    out_.line("[[gnu::constructor(101)]] inline void bind() {{");
    out_.line("  if (users++ == 0) {{");
    out_.line("    indurop_register_refs(refs, {}, ::indurop::abi::kVersion);", variables_.size());
    out_.line("  }}");
    out_.line("}}");
    out_.line("[[gnu::destructor(101)]] inline void unbind() {{");
    out_.line("  if (--users == 0) {{");
    out_.line("    indurop_unregister_refs(refs);");
    out_.line("  }}");
    out_.line("}}");
  }

  // Returns the text between the braces of the object.
  static std::string initial_value(const schema::Variable& v) {
    const std::string text = initializer_text(v.type, v.initial.data());
    const bool has_braces = !v.type.dims.empty() || v.type.base == schema::Base::Struct;
    return has_braces ? text.substr(1, text.size() - 2) : text;
  }

  static const char* kind(const schema::Variable& v) { return v.kind == abi::Kind::Scalar ? "Scalar" : "Ring"; }

  void tag(const schema::Variable& v, std::size_t index) {
    out_.line("struct var_{} {{", mangled(v.name));
    out_.line("  static constexpr ::std::uint64_t kNameHash = {};", hex(v.name_hash()));
    out_.line("  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::{};", kind(v));
    out_.line("  static constexpr ::std::size_t kSize = {};", v.type.size());
    if (v.maxage_ns > 0) {
      out_.line("  static constexpr ::std::int64_t kMaxAgeNs = {};", v.maxage_ns);
    }
    out_.line(
        "  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept {{ return refs[{}]; }}",
        index);
    out_.line("}};");
  }

  void shape_union(const schema::Type& type) {
    const std::string name = fmt::format("ref_{}", mangled(type.name));
    out_.line("template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>");
    out_.line("union {} {{", name);
    out_.line("  using value_type = ::{};", type.name);
    out_.line("  using whole_type = value_type;");
    out_.line("  using tag_type = indurop_tag;");
    out_.line("  static constexpr ::std::uint32_t kOffset = indurop_offset;");
    out_.line("  ::indurop::Place indurop_place;");
    for (const schema::Field& field : type.fields) {
      out_.line("  {} {};", shape(field.type, "indurop_tag", fmt::format("indurop_offset + {}", field.offset)),
                field.name);
    }
    out_.line("  INDUROP_UNION_SHAPE({})", name);
    const bool hidden = std::any_of(type.fields.begin(), type.fields.end(), [](const schema::Field& field) {
      return field.name == "age" || field.name == "valid";
    });
    if (!hidden) {
      out_.line("  INDUROP_FRESHNESS(indurop_tag)");
    }
    out_.line("}};");
  }

  // Returns the shape of a value at a static offset; array indices are added at run time.
  [[nodiscard]] std::string shape(const schema::Type& type, const std::string& tag, const std::string& offset) const {
    std::string out;
    if (type.base == schema::Base::Text) {
      out = fmt::format("::indurop::Text<{}, {}, {}>", tag, type.text_size, offset);
    } else if (type.base == schema::Base::Struct) {
      out = fmt::format("::{}::ref_{}<{}, {}>", hidden_names_[program_.owner.at(type.name)], mangled(type.name), tag,
                        offset);
    } else {
      schema::Type element = type;
      element.dims.clear();
      out = fmt::format("::indurop::Leaf<{}, {}, {}>", tag, cpp_type(element), offset);
    }
    for (auto dim = type.dims.rbegin(); dim != type.dims.rend(); ++dim) {
      out = fmt::format("::indurop::ArrayRef<{}, {}>", out, *dim);
    }
    return out;
  }

  [[nodiscard]] static std::string result_type(const schema::Function& function) {
    return is_void(function.result) ? "void" : cpp_type(function.result);
  }

  void function_tag(const schema::Function& function) {
    const bool has_arguments = !is_void(function.arguments);
    std::string arguments;
    for (const schema::Field& field : function.arguments.fields) {
      arguments += (arguments.empty() ? "a." : ", a.") + field.name;
    }
    out_.line("struct fn_{} {{", mangled(function.name));
    out_.line("  using args = ::{};", function.arguments.name);
    out_.line("  using result = {};", result_type(function));
    out_.line("  static constexpr const char* kName = \"{}\";", function.name);
    out_.line("  static constexpr ::std::uint64_t kNameHash = {};",
              hex(abi::fnv1a64(function.name.data(), function.name.size())));
    out_.line("  static constexpr ::std::uint64_t kTypeHash = {};", hex(function.type_hash));
    out_.line("  static constexpr ::std::int64_t kDeadlineNs = {};", function.deadline_ns);
    out_.line("  template <class F>");
    out_.line("  static result apply(F&& f, const args&{}) {{", has_arguments ? " a" : " /*none*/");
    out_.line("    return f({});", arguments);
    out_.line("  }}");
    out_.line("}};");
  }

  void pool_tag(const schema::Pool& pool) {
    out_.line("struct pool_{} {{", mangled(pool.name));
    out_.line("  using chunk_type = ::{};", pool.type.name);
    out_.line("  static constexpr const char* kName = \"{}\";", pool.name);
    out_.line("  static constexpr ::std::uint64_t kNameHash = {};", hex(pool.name_hash()));
    out_.line("  static constexpr ::std::uint64_t kTypeHash = {};", hex(pool.type_hash));
    out_.line("}};");
  }

  // ---- what modules use

  void objects() {
    for (const Item& item : unit_.items) {
      if (const auto* v = std::get_if<schema::Variable>(&item)) {
        out_.enter(scope_of(v->name));
        const std::string tag = fmt::format("::{}::var_{}", hidden_, mangled(v->name));
        std::string type = shape(v->type, tag, "0");
        if (type.starts_with(kLeaf)) {
          type.replace(0, kLeaf.size(), kChosenLeaf);
        }
        out_.line("inline constexpr {} {}{{::indurop::Place{{0}}, ::indurop::detail::Make{{}}}};{}", type,
                  last_of(v->name), about(v->description, v->unit));
      } else if (const auto* f = std::get_if<schema::Function>(&item)) {
        out_.enter(scope_of(f->name));
        std::string types;
        for (const schema::Field& field : f->arguments.fields) {
          types += (types.empty() ? "" : ", ") + cpp_type(field.type);
        }
        out_.line("inline constexpr ::indurop::Function<::{}::fn_{}, {}({})> {}{{}};{}", hidden_, mangled(f->name),
                  result_type(*f), types, last_of(f->name), HeaderText::comment(f->description));
      } else if (const auto* p = std::get_if<schema::Pool>(&item)) {
        out_.enter(scope_of(p->name));
        out_.line("inline constexpr ::indurop::Pool<::{}::pool_{}> {}{{}};{}", hidden_, mangled(p->name),
                  last_of(p->name), HeaderText::comment(p->description));
      }
    }
    out_.enter("");
  }

  const Program& program_;
  const GlbFile& unit_;
  const std::vector<std::string>& hidden_names_;
  std::string hidden_;
  std::vector<const schema::Variable*> variables_;
  std::vector<const schema::Function*> functions_;
  std::vector<const schema::Pool*> pools_;
  HeaderText out_;
};

}  // namespace

std::vector<Header> emit_cpp(const Program& program) {
  std::vector<Header> headers;
  std::vector<std::string> names(program.units.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = std::string(kHidden).append(kNoHash);
    std::string text = CppWriter(program, i, names).run();
    const std::string hash = fmt::format("{:016x}", abi::fnv1a64(text.data(), text.size()));
    for (const std::string_view name : {kHidden, kHiddenSchema}) {
      set_hash(text, std::string(name).append(kNoHash), hash);
    }
    names[i] = std::string(kHidden).append(hash);
    headers.push_back({names[i], std::move(text)});
  }
  return headers;
}

}  // namespace indurop::glb2idl
