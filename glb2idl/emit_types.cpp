// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/emit_types.h"

#include <array>
#include <cstring>

#include "glb2idl/emit.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

class TypesWriter {
 public:
  explicit TypesWriter(HeaderText& out) : out_(out) {}

  void operator()(const Constant& constant) {
    out_.enter(scope_of(constant.name));
    const std::string_view name = last_of(constant.name);
    const Value& value = constant.value;
    if (value.kind == Value::Kind::Text) {
      out_.line("inline constexpr char {}[] = \"{}\";{}", name, escape(value.text),
                HeaderText::comment(constant.description));
    } else if (!value.enum_type.empty()) {
      out_.line("inline constexpr ::{0} {1}{{static_cast<::{0}>({2})}};{3}", value.enum_type, name,
                to_text(value.integer), HeaderText::comment(constant.description));
    } else {
      schema::Type type;
      type.base = base_of(constant);
      out_.line("inline constexpr {} {}{{{}}};{}", cpp_type(type), name, literal_of(constant),
                HeaderText::comment(constant.description));
    }
  }

  void operator()(const Enumeration& enumeration) {
    out_.enter(enumeration.scope);
    std::string values;
    for (const schema::Enumerator& e : enumeration.type.enumerators) {
      values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", e.name, e.value);
    }
    out_.line("enum {}{}: ::std::int32_t {{ {} }};{}", last_of(enumeration.type.name),
              enumeration.type.name.empty() ? "" : " ", values, HeaderText::comment(enumeration.description));
  }

  void operator()(const Structure& structure) {
    const schema::Type& type = structure.type;
    out_.enter(scope_of(type.name));
    const std::string_view name = last_of(type.name);
    out_.line("struct {} {{{}", name, HeaderText::comment(structure.description));
    fields(type);
    out_.line("  friend bool operator==(const {0}&, const {0}&) = default;", name);
    out_.line("}};");
    layout_check(type, name);
    out_.line("template <class indurop_visitor>");
    out_.line("constexpr void indurop_fields(const {}& v, indurop_visitor f) {{", name);
    for (const schema::Field& field : type.fields) {
      out_.line("  f(\"{0}\", v.{0});", field.name);
    }
    out_.line("}}");
  }

  void operator()(const Alias& alias) {
    out_.enter(scope_of(alias.name));
    out_.line("using {} = {};", last_of(alias.name), cpp_type(alias.type));
  }

  void operator()(const schema::Variable& /*unused*/) {}
  void operator()(const schema::Pool& /*unused*/) {}

  void operator()(const schema::Function& function) {
    out_.enter(scope_of(function.name));
    const std::string_view name = last_of(function.arguments.name);
    out_.line("struct {} {{", name);
    fields(function.arguments);
    out_.line("}};");
    if (!is_void(function.arguments)) {
      layout_check(function.arguments, name);
    }
  }

 private:
  void fields(const schema::Type& type) {
    for (const schema::Field& field : type.fields) {
      out_.line("  {} {}{{}};{}", cpp_type(field.type), field.name, about(field.description, field.unit));
    }
  }

  void layout_check(const schema::Type& type, std::string_view name) {
    out_.line("static_assert(sizeof({0}) == {1} && alignof({0}) == {2});", name, type.element_size, type.align);
    for (const schema::Field& field : type.fields) {
      out_.line("static_assert(offsetof({}, {}) == {});", name, field.name, field.offset);
    }
  }

  HeaderText& out_;
};

}  // namespace

void emit_types(const GlbFile& unit, HeaderText& out) {
  TypesWriter writer(out);
  for (const Item& item : unit.items) {
    std::visit(writer, item);
  }
}

Base base_of(const Constant& constant) {
  const Value& value = constant.value;
  if (constant.base) {
    return *constant.base;
  }
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

std::string literal_of(const Constant& constant) {
  const Value& value = constant.value;
  schema::Type type;
  type.base = base_of(constant);
  std::array<std::uint8_t, 8> bytes{};
  const auto single = static_cast<float>(value.real);
  if (type.base == Base::Float) {
    std::memcpy(bytes.data(), &single, sizeof single);
  } else if (type.base == Base::Double) {
    std::memcpy(bytes.data(), &value.real, sizeof value.real);
  } else {
    const auto bits = static_cast<std::uint64_t>(value.integer);
    std::memcpy(bytes.data(), &bits, sizeof bits);
  }
  return initializer_text(type, bytes.data());
}

std::string about(const std::string& description, const std::string& unit) {
  return HeaderText::comment(unit.empty() ? description
                                          : fmt::format("{}{}[{}]", description, description.empty() ? "" : " ", unit));
}

}  // namespace indurop::glb2idl
