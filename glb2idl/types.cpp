// SPDX-License-Identifier: Apache-2.0
// Resolves types and lays them out.

#include "glb2idl/types.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/nearest.h"
#include "glb2idl/notes.h"
#include "glb2idl/text.h"
#include "glb2idl/type_words.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

schema::Type base_type(Base base) {
  schema::Type type;
  type.base = base;
  type.element_size = schema::size_of(base);
  type.align = type.element_size;
  return type;
}

std::size_t depth_of(const schema::Type& type) noexcept {
  std::size_t deepest = 0;
  for (const schema::Field& field : type.fields) {
    deepest = std::max(deepest, depth_of(field.type));
  }
  return deepest + (type.base == Base::Struct ? 1 : 0);
}

}  // namespace

std::size_t parts_of(const schema::Type& type) noexcept {
  std::size_t parts = 1 + type.enumerators.size();
  for (const schema::Field& field : type.fields) {
    parts += parts_of(field.type);
  }
  return parts;
}

bool count_parts(Context& context, const schema::Type& type, Span at) {
  if (context.total_parts <= kMaxTotalParts) {
    context.total_parts += parts_of(type);
  }
  if (context.total_parts > kMaxTotalParts) {
    context.error(at,
                  fmt::format("all types and variables have more than {} fields together, use arrays", kMaxTotalParts));
    return false;
  }
  return true;
}

std::optional<schema::Type> TypeBuilder::resolve(const ast::TypeSpec& spec, const std::string& hint,
                                                 const std::string& comment) {
  using Kind = ast::TypeSpec::Kind;
  switch (spec.kind) {
    case Kind::Base:
      return base_type(spec.base);
    case Kind::Void:
      context_.error(spec.at, "void is the result of a function only, use a type such as int32_t");
      return std::nullopt;
    case Kind::Named:
      return named(spec);
    case Kind::Struct:
    case Kind::Enum:
      break;
  }
  if (spec.tag) {
    return define(spec, *spec.tag, comment);
  }
  if (hint.empty() && spec.kind == Kind::Enum) {
    return define_enum(*spec.enumeration, "", spec.at, comment);
  }
  if (hint.empty()) {
    context_.error(spec.at, "this struct needs a name: struct Name { ... }");
    return std::nullopt;
  }
  const ast::Name name = derived_name(hint, spec.at);
  return spec.kind == Kind::Struct ? define_struct(spec, name, hint, comment) : define(spec, name, comment);
}

// Returns <hint>_t, unless the C library has a type of that name (mode_t, time_t).
ast::Name TypeBuilder::derived_name(const std::string& hint, Span at) const {
  const std::string usual = hint + "_t";
  const bool taken = objection(usual, NameRole::Type, context_.current.empty()).has_value();
  return {taken ? hint + "_type" : usual, at};
}

std::optional<schema::Type> TypeBuilder::define(const ast::TypeSpec& spec, const ast::Name& name,
                                                const std::string& comment) {
  if (spec.kind == ast::TypeSpec::Kind::Struct) {
    return define_struct(spec, name, name.text, comment);
  }
  const bool good_name = context_.check_name(name, NameRole::Type);
  Symbol symbol;
  symbol.kind = Symbol::Kind::Type;
  symbol.at = name.at;
  const std::string full_name = context_.full(name.text);
  auto type = define_enum(*spec.enumeration, full_name, name.at, comment);
  if (!type || !good_name || !context_.scope.claim_idl(full_name, name.at, false)) {
    context_.declare(name, Symbol::Kind::Broken);
    return std::nullopt;
  }
  symbol.type = *type;
  if (!context_.scope.declare(full_name, std::move(symbol))) {
    return std::nullopt;
  }
  return type;
}

std::optional<schema::Type> TypeBuilder::define_enum(const ast::EnumBody& body, const std::string& full_name, Span at,
                                                     const std::string& comment) {
  Enumeration result;
  result.type = base_type(Base::Enum);
  result.type.name = full_name;
  result.scope = context_.current;
  result.description = comment;
  bool good = true;
  if (body.items.empty()) {
    context_.error(at, "an enum needs at least one value: enum Mode { OFF, ON };");
    good = false;
  }
  for (const ast::EnumBody::Item& item : body.items) {
    const auto expected = static_cast<Wide>(result.type.enumerators.size());
    if (item.value) {
      const auto value = context_.evaluate(*item.value);
      good = good && value;
      if (value && (value->kind != Value::Kind::Integer || value->integer != expected)) {
        context_.error(item.value->at,
                       fmt::format("the values of an enum count 0, 1, 2, ...: this one is {}; use #define for "
                                   "other numbers",
                                   to_text(expected)));
        good = false;
      }
    }
    Symbol symbol;
    symbol.kind = Symbol::Kind::Constant;
    symbol.at = item.name.at;
    symbol.value.integer = expected;
    symbol.value.enum_type = full_name;
    const std::string value_name = context_.full(item.name.text);
    const bool named_well = context_.check_name(item.name, NameRole::Enumerator) &&
                            context_.scope.declare(value_name, symbol) &&
                            context_.scope.claim_idl(value_name, item.name.at, false);
    good = good && named_well;
    result.type.enumerators.push_back({item.name.text, static_cast<std::int64_t>(expected)});
  }
  if (!good) {
    return std::nullopt;
  }
  schema::Type type = result.type;
  context_.add(std::move(result));
  return type;
}

// Empty, too, if the error that needs it would not be shown.
std::string TypeBuilder::similar_type(const std::string& name) const {
  if (context_.diagnostics.full()) {
    return {};
  }
  std::vector<std::string> known = context_.scope.names(Symbol::Kind::Type, context_.file);
  known.insert(known.end(), type_names().begin(), type_names().end());
  return base::nearest(name, known);
}

std::optional<schema::Type> TypeBuilder::named(const ast::TypeSpec& spec) {
  const Symbol* found = context_.scope.find(context_.current, spec.path.parts, context_.file);
  const std::string shown = join_names(spec.path.parts, "::");
  if (found != nullptr && found->kind == Symbol::Kind::Type) {
    const schema::Type& type = found->type;
    const std::string top = type.name.substr(0, type.name.find("::"));
    if (!type.name.empty() && top != type.name && context_.scope.hides(context_.current, top)) {
      context_.error(spec.at,
                     fmt::format("inside namespace {} another '{}' hides that of {} in IDL, rename one of them",
                                 context_.current, top, type.name));
      return std::nullopt;
    }
    return type;
  }
  if (found != nullptr && found->kind != Symbol::Kind::Broken) {
    context_.error(spec.at, fmt::format("'{}' is not a type, a type was expected here", shown));
  } else if (found == nullptr && !context_.is_broken(spec.path)) {
    const std::string_view substitute = substitute_for(spec.path.parts.front());
    const std::string near = substitute.empty() ? similar_type(spec.path.parts.back()) : std::string(substitute);
    context_.error(spec.at, near.empty()
                                ? fmt::format("there is no type '{}', declare it above or include its file", shown)
                            : substitute.empty() ? fmt::format("there is no type '{}', did you mean '{}'?", shown, near)
                                                 : fmt::format("there is no type '{}', write {}", shown, near));
  }
  return std::nullopt;
}

std::optional<schema::Type> TypeBuilder::define_struct(const ast::TypeSpec& spec, const ast::Name& name,
                                                       const std::string& hint, const std::string& comment) {
  Structure result;
  result.description = comment;
  schema::Type& type = result.type;
  type.base = Base::Struct;
  type.name = context_.full(name.text);
  bool good = context_.check_name(name, NameRole::Type);
  Seen seen;
  for (const ast::Declaration& declaration : spec.structure->fields) {
    good = add_fields(declaration, hint, type, seen) && good;
  }
  if (good && type.fields.empty()) {
    context_.error(spec.at, "a struct needs at least one field");
    good = false;
  }
  good = good && lay_out(type, name.at) && context_.scope.claim_idl(type.name, name.at, true) &&
         context_.scope.claim_cpp("ref_", type.name, name.at);
  Symbol symbol;
  symbol.kind = good ? Symbol::Kind::Type : Symbol::Kind::Broken;
  symbol.at = name.at;
  symbol.type = type;
  if (!context_.scope.declare(type.name, std::move(symbol)) || !good) {
    return std::nullopt;
  }
  context_.program.owner.emplace(type.name, context_.unit);
  schema::Type copy = type;
  context_.add(std::move(result));
  return copy;
}

bool TypeBuilder::add_fields(const ast::Declaration& declaration, const std::string& hint, schema::Type& to,
                             Seen& seen) {
  if (declaration.kind != ast::Declaration::Kind::Plain) {
    context_.error(declaration.at, "inside a struct there are only fields, declare this before the struct");
    return false;
  }
  const std::string inner = declaration.declarators.empty() ? "" : hint + "_" + declaration.declarators[0].name.text;
  const auto type = resolve(declaration.type, inner, declaration.description);
  bool good = type.has_value();
  for (const ast::Declarator& declarator : declaration.declarators) {
    good = check_field(declarator, to, seen) && good;
    auto whole = type ? with_dims(*type, declarator) : std::nullopt;
    if (!whole || !count_parts(context_, *whole, declarator.name.at)) {
      good = false;
      continue;
    }
    Notes notes = read_notes(context_, declaration.annotations, declarator.annotations, *whole, NoteTarget::Field,
                             declaration.description);
    schema::Field field;
    field.name = declarator.name.text;
    field.type = std::move(*whole);
    field.unit = std::move(notes.unit);
    field.description = std::move(notes.description);
    field.range = notes.range;
    field.alarms = std::move(notes.alarms);
    context_.field_names.insert(field.name);
    to.fields.push_back(std::move(field));
  }
  return good;
}

bool TypeBuilder::check_field(const ast::Declarator& declarator, const schema::Type& owner, Seen& seen) {
  const ast::Name& name = declarator.name;
  bool good = context_.check_name(name, NameRole::Field);
  if (declarator.initial) {
    context_.error(declarator.initial->at, "a field has no value of its own, give the variable one: P p = {1, 2};");
    good = false;
  }
  const auto [other, is_new] = seen.emplace(lower(name.text), name.text);
  if (!is_new) {
    context_.error(name.at,
                   other->second == name.text
                       ? fmt::format("the struct already has a field '{}', choose another name", name.text)
                       : fmt::format("'{}' and '{}' differ only in case, which IDL does not distinguish, rename one",
                                     name.text, other->second));
    return false;
  }
  if (lower(last_of(owner.name)) == lower(name.text)) {
    context_.error(
        name.at,
        fmt::format("IDL allows no field named like its struct, choose another name such as '{}_value'", name.text));
    return false;
  }
  const std::vector<std::string> parts{name.text};
  const Symbol* same = context_.scope.find(context_.current, parts, context_.file);
  if (same != nullptr && same->kind == Symbol::Kind::Type) {
    context_.error(name.at,
                   fmt::format("'{}' is a type, a field of that name hides it, choose another name such as '{}_value'",
                               name.text, name.text));
    return false;
  }
  return good;
}

std::optional<std::uint32_t> TypeBuilder::dimension(const ast::Dimension& from, const ast::Declarator& declarator,
                                                    bool first, bool is_text) {
  if (!from.size) {
    const auto& initial = declarator.initial;
    if (first && initial && initial->value && is_text) {
      const auto value = context_.evaluate(*initial->value);
      if (!value) {
        return std::nullopt;
      }
      return static_cast<std::uint32_t>(std::max<std::size_t>(2, value->text.size() + 1));
    }
    if (first && initial && !initial->value && !initial->list.empty() && !is_text) {
      return static_cast<std::uint32_t>(initial->list.size());
    }
    context_.error(from.at, "the size of this array is missing, write it between the brackets");
    return std::nullopt;
  }
  const auto value = context_.evaluate(*from.size);
  if (!value) {
    return std::nullopt;
  }
  if (value->kind != Value::Kind::Integer) {
    context_.error(from.size->at, fmt::format("the size of an array is a whole number, this is {}", to_text(*value)));
    return std::nullopt;
  }
  if (value->integer < 1 || value->integer > static_cast<Wide>(kMaxVariableBytes)) {
    context_.error(from.size->at, fmt::format("the size of an array is 1 or more and at most {}, this is {}",
                                              kMaxVariableBytes, to_text(value->integer)));
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(value->integer);
}

std::optional<schema::Type> TypeBuilder::with_dims(schema::Type type, const ast::Declarator& declarator) {
  if (declarator.dims.empty()) {
    return type;
  }
  std::vector<std::uint32_t> dims;
  for (std::size_t i = 0; i < declarator.dims.size(); ++i) {
    const bool is_text = type.base == Base::Char && i + 1 == declarator.dims.size();
    const auto size = dimension(declarator.dims[i], declarator, i == 0, is_text);
    if (!size) {
      return std::nullopt;
    }
    dims.push_back(*size);
  }
  const Span at = join(declarator.dims.front().at, declarator.dims.back().at);
  if (type.base == Base::Char) {
    type.base = Base::Text;
    type.text_size = dims.back();
    type.element_size = dims.back();
    dims.pop_back();
    if (type.text_size < 2) {
      context_.error(at, "a char array is a text and its last byte is a NUL: 2 is the smallest size, or use int8_t");
      return std::nullopt;
    }
  }
  type.dims.insert(type.dims.begin(), dims.begin(), dims.end());
  if (type.dims.size() > kMaxDims) {
    context_.error(at, fmt::format("an array has at most {} dimensions, use a struct inside", kMaxDims));
    return std::nullopt;
  }
  if (type.size() > kMaxVariableBytes) {
    context_.error(
        at, fmt::format("this array is larger than {} MiB, the limit of one variable", kMaxVariableBytes >> 20U));
    return std::nullopt;
  }
  return type;
}

bool TypeBuilder::lay_out(schema::Type& type, Span at) {
  std::uint64_t offset = 0;
  type.align = 1;
  for (schema::Field& field : type.fields) {
    const std::uint64_t align = field.type.align;
    offset = (offset + align - 1) / align * align;
    field.offset = static_cast<std::uint32_t>(offset);
    offset += field.type.size();
    type.align = std::max(type.align, field.type.align);
    if (offset > kMaxVariableBytes) {
      context_.error(at, fmt::format("'{}' is larger than {} MiB, the limit of one variable", last_of(type.name),
                                     kMaxVariableBytes >> 20U));
      return false;
    }
  }
  type.element_size = static_cast<std::uint32_t>((offset + type.align - 1) / type.align * type.align);
  if (depth_of(type) > kMaxStructDepth) {
    context_.error(at, fmt::format("structs inside structs are at most {} deep, make them flatter", kMaxStructDepth));
    return false;
  }
  if (parts_of(type) > kMaxTypeParts) {
    context_.error(at, fmt::format("'{}' has more than {} fields with those of its inner structs, use arrays",
                                   last_of(type.name), kMaxTypeParts));
    return false;
  }
  return true;
}

}  // namespace indurop::glb2idl
