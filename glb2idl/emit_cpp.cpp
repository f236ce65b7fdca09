// SPDX-License-Identifier: Apache-2.0
// The C++ header of one .glb: value types, then the hidden part (table of references, shapes), then the variables.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include "glb2idl/emit.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

constexpr std::size_t kLine = 100;  // bytes of schema text in one line

std::string hex(std::uint64_t value) {
  return fmt::format("0x{:016x}", value);
}

template <class T>
std::vector<const T*> all_of(const Unit& unit) {
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
        functions_(all_of<schema::Function>(unit_)) {}

  std::string run() {
    head();
    for (const Item& item : unit_.items) {
      std::visit(*this, item);
    }
    enter("");
    hidden_part();
    objects();
    return std::move(out_);
  }

  // ---- values: constants, enums, structs

  void operator()(const Constant& constant) {
    enter(scope_of(constant.name));
    const std::string_view name = last_of(constant.name);
    const Value& value = constant.value;
    if (value.kind == Value::Kind::Text) {
      line("inline constexpr char {}[] = \"{}\";{}", name, escape(value.text), comment(constant.description));
    } else if (!value.enum_type.empty()) {
      line("inline constexpr ::{0} {1}{{static_cast<::{0}>({2})}};{3}", value.enum_type, name, to_text(value.integer),
           comment(constant.description));
    } else {
      schema::Type type;
      type.base = constant.base.value_or(natural_base(value));
      line("inline constexpr {} {}{{{}}};{}", cpp_type(type), name, constant_text(type.base, value),
           comment(constant.description));
    }
  }

  void operator()(const Enumeration& enumeration) {
    enter(enumeration.scope);
    std::string values;
    for (const schema::Enumerator& e : enumeration.type.enumerators) {
      values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", e.name, e.value);
    }
    line("enum {}{}: ::std::int32_t {{ {} }};{}", last_of(enumeration.type.name),
         enumeration.type.name.empty() ? "" : " ", values, comment(enumeration.description));
  }

  void operator()(const Structure& structure) {
    const schema::Type& type = structure.type;
    enter(scope_of(type.name));
    const std::string_view name = last_of(type.name);
    line("struct {} {{{}", name, comment(structure.description));
    fields(type);
    line("  friend bool operator==(const {0}&, const {0}&) = default;", name);
    line("}};");
    layout_check(type, name);
    line("template <class indurop_visitor>");
    line("constexpr void indurop_fields(const {}& v, indurop_visitor f) {{", name);
    for (const schema::Field& field : type.fields) {
      line("  f(\"{0}\", v.{0});", field.name);
    }
    line("}}");
  }

  void operator()(const Alias& alias) {
    enter(scope_of(alias.name));
    line("using {} = {};", last_of(alias.name), cpp_type(alias.type));
  }

  void operator()(const schema::Variable& /*unused*/) {}

  void operator()(const schema::Function& function) {
    enter(scope_of(function.name));
    const std::string_view name = last_of(function.arguments.name);
    line("struct {} {{", name);
    fields(function.arguments);
    line("}};");
    if (!is_void(function.arguments)) {
      layout_check(function.arguments, name);
    }
  }

 private:
  template <class... Argument>
  void line(fmt::format_string<Argument...> format, Argument&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Argument>(arguments)...);
    out_ += '\n';
  }

  void enter(std::string_view scope) {
    if (scope == current_) {
      return;
    }
    if (!current_.empty()) {
      line("}}  // namespace {}", current_);
    }
    if (!scope.empty()) {
      line("");
      line("namespace {} {{", scope);
    }
    current_ = scope;
  }

  static std::string comment(const std::string& text) { return text.empty() ? "" : "  // " + comment_line(text); }

  void head() {
    line("// Shared variables of {}.glb, written by glb2idl. Do not edit.", unit_.stem);
    line("#pragma once");
    line("");
    line("#include <indurop/lock.h>");
    line("#include <indurop/var.h>");
    if (!functions_.empty()) {
      line("#include <indurop/function.h>");
    }
    line("");
    line("#include <array>");
    line("#include <cstddef>");
    line("#include <cstdint>");
    for (const std::size_t other : unit_.includes) {
      line("");
      line("#include \"{}.glb.h\"", program_.units[other].stem);
    }
    if (!variables_.empty() || !functions_.empty()) {
      schema_text();
    }
  }

  // The schema: one JSON text, not loaded at run time, one copy per object file and program thanks to comdat.
  void schema_text() {
    const std::string json = schema::to_json(schema_of(unit_));
    line("");
    line("asm(R\"indurop(.pushsection .indurop.schema,\"G\",%progbits,indurop_schema_{},comdat",
         hidden_.substr(hidden_.rfind('_') + 1));
    for (std::size_t at = 0; at < json.size(); at += kLine) {
      line(".ascii \"{}\"", escape(std::string_view(json).substr(at, kLine)));
    }
    line(".ascii \"\\n\"");
    line(".popsection)indurop\");");
  }

  void fields(const schema::Type& type) {
    for (const schema::Field& field : type.fields) {
      std::string about = field.description;
      if (!field.unit.empty()) {
        about += fmt::format("{}[{}]", about.empty() ? "" : " ", field.unit);
      }
      line("  {} {}{{}};{}", cpp_type(field.type), field.name, comment(about));
    }
  }

  void layout_check(const schema::Type& type, std::string_view name) {
    line("static_assert(sizeof({0}) == {1} && alignof({0}) == {2});", name, type.element_size, type.align);
    for (const schema::Field& field : type.fields) {
      line("static_assert(offsetof({}, {}) == {});", name, field.name, field.offset);
    }
  }

  static Base natural_base(const Value& value) {
    if (value.kind == Value::Kind::Bool) {
      return Base::Bool;
    }
    if (value.kind == Value::Kind::Real) {
      return Base::Double;
    }
    return value.integer > INT64_MAX                                   ? Base::UInt64
           : value.integer == static_cast<std::int32_t>(value.integer) ? Base::Int32
                                                                       : Base::Int64;
  }

  static std::string constant_text(Base base, const Value& value) {
    schema::Type type;
    type.base = base;
    std::array<std::uint8_t, 8> bytes{};
    const auto single = static_cast<float>(value.real);
    if (base == Base::Float) {
      std::memcpy(bytes.data(), &single, sizeof single);
    } else if (base == Base::Double) {
      std::memcpy(bytes.data(), &value.real, sizeof value.real);
    } else {
      const auto bits = static_cast<std::uint64_t>(value.integer);
      std::memcpy(bytes.data(), &bits, sizeof bits);
    }
    return initializer_text(type, bytes.data());
  }

  // ---- the hidden part

  void hidden_part() {
    line("");
    line("namespace {} __attribute__((visibility(\"hidden\"))) {{", hidden_);
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
    line("}}  // namespace {}", hidden_);
  }

  void references() {
    for (const schema::Variable* v : variables_) {
      if (!v->initial.empty()) {
        line("inline constexpr {} initial_{}{{{}}};", cpp_type(v->type), mangled(v->name), initial_value(*v));
      }
    }
    line("inline constinit ::indurop::abi::Ref refs[] = {{");
    for (const schema::Variable* v : variables_) {
      line("    {{{}, {}, nullptr, {}, {}, ::indurop::abi::Kind::{}, \"{}\"}},", hex(v->name_hash()), hex(v->type_hash),
           v->initial.empty() ? "nullptr" : fmt::format("&initial_{}", mangled(v->name)), v->type.size(), kind(*v),
           v->name);
    }
    line("}};");
    // Each object file of a module has this constructor; the table is made known once.
    line("inline constinit ::std::uint32_t users = 0;");
    line("[[gnu::constructor(101)]] inline void bind() {{");
    line("  if (users++ == 0) {{");
    line("    indurop_register_refs(refs, {}, ::indurop::abi::kVersion);", variables_.size());
    line("  }}");
    line("}}");
    line("[[gnu::destructor(101)]] inline void unbind() {{");
    line("  if (--users == 0) {{");
    line("    indurop_unregister_refs(refs);");
    line("  }}");
    line("}}");
  }

  // What stands between the braces of the object.
  static std::string initial_value(const schema::Variable& v) {
    const std::string text = initializer_text(v.type, v.initial.data());
    const bool has_braces = !v.type.dims.empty() || v.type.base == Base::Struct;
    return has_braces ? text.substr(1, text.size() - 2) : text;
  }

  static const char* kind(const schema::Variable& v) { return v.kind == abi::Kind::Scalar ? "Scalar" : "Ring"; }

  void tag(const schema::Variable& v, std::size_t index) {
    line("struct var_{} {{", mangled(v.name));
    line("  static constexpr ::std::uint64_t kNameHash = {};", hex(v.name_hash()));
    line("  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::{};", kind(v));
    line("  static constexpr ::std::size_t kSize = {};", v.type.size());
    if (v.maxage_ns > 0) {
      line("  static constexpr ::std::int64_t kMaxAgeNs = {};", v.maxage_ns);
    }
    line("  INDUROP_ALWAYS_INLINE static const ::indurop::abi::Ref& ref() noexcept {{ return refs[{}]; }}", index);
    line("}};");
  }

  void shape_union(const schema::Type& type) {
    const std::string name = fmt::format("ref_{}", mangled(type.name));
    line("template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>");
    line("union {} {{", name);
    line("  using value_type = ::{};", type.name);
    line("  using whole_type = value_type;");
    line("  using tag_type = indurop_tag;");
    line("  static constexpr ::std::uint32_t kOffset = indurop_offset;");
    line("  ::indurop::Place indurop_place;");
    for (const schema::Field& field : type.fields) {
      line("  {} {};", shape(field.type, "indurop_tag", fmt::format("indurop_offset + {}", field.offset)), field.name);
    }
    line("  INDUROP_UNION_SHAPE({})", name);
    const bool hidden = std::any_of(type.fields.begin(), type.fields.end(), [](const schema::Field& field) {
      return field.name == "age" || field.name == "valid";
    });
    if (!hidden) {
      line("  INDUROP_FRESHNESS(indurop_tag)");
    }
    line("}};");
  }

  // The shape of a value at a static offset; array indices are added at run time.
  [[nodiscard]] std::string shape(const schema::Type& type, const std::string& tag, const std::string& offset) const {
    std::string out;
    if (type.base == Base::Text) {
      out = fmt::format("::indurop::Text<{}, {}, {}>", tag, type.text_size, offset);
    } else if (type.base == Base::Struct) {
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
    line("struct fn_{} {{", mangled(function.name));
    line("  using args = ::{};", function.arguments.name);
    line("  using result = {};", result_type(function));
    line("  static constexpr const char* kName = \"{}\";", function.name);
    line("  static constexpr ::std::uint64_t kNameHash = {};",
         hex(abi::fnv1a64(function.name.data(), function.name.size())));
    line("  static constexpr ::std::uint64_t kTypeHash = {};", hex(function.type_hash));
    line("  static constexpr ::std::int64_t kDeadlineNs = {};", function.deadline_ns);
    line("  template <class F>");
    line("  static result apply(F&& f, const args&{}) {{", has_arguments ? " a" : " /*none*/");
    line("    return f({});", arguments);
    line("  }}");
    line("}};");
  }

  // ---- what modules use

  void objects() {
    for (const Item& item : unit_.items) {
      if (const auto* v = std::get_if<schema::Variable>(&item)) {
        enter(scope_of(v->name));
        const std::string tag = fmt::format("::{}::var_{}", hidden_, mangled(v->name));
        std::string about = v->description;
        if (!v->unit.empty()) {
          about += fmt::format("{}[{}]", about.empty() ? "" : " ", v->unit);
        }
        line("inline constexpr {} {}{{::indurop::Place{{0}}, ::indurop::detail::Make{{}}}};{}",
             shape(v->type, tag, "0"), last_of(v->name), comment(about));
      } else if (const auto* f = std::get_if<schema::Function>(&item)) {
        enter(scope_of(f->name));
        std::string types;
        for (const schema::Field& field : f->arguments.fields) {
          types += (types.empty() ? "" : ", ") + cpp_type(field.type);
        }
        line("inline constexpr ::indurop::Function<::{}::fn_{}, {}({})> {}{{}};{}", hidden_, mangled(f->name),
             result_type(*f), types, last_of(f->name), comment(f->description));
      }
    }
    enter("");
  }

  const Program& program_;
  const Unit& unit_;
  const std::vector<std::string>& hidden_names_;
  std::string hidden_;
  std::vector<const schema::Variable*> variables_;
  std::vector<const schema::Function*> functions_;
  std::string out_;
  std::string current_;
};

}  // namespace

std::vector<std::string> hidden_names(const Program& program) {
  std::vector<std::string> names(program.units.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = "indurop_generated_0";
    const std::string text = program.units[i].stem + CppWriter(program, i, names).run();
    names[i] = fmt::format("indurop_generated_{:016x}", abi::fnv1a64(text.data(), text.size()));
  }
  return names;
}

std::string emit_cpp(const Program& program, std::size_t unit, const std::vector<std::string>& hidden) {
  return CppWriter(program, unit, hidden).run();
}

}  // namespace indurop::glb2idl
