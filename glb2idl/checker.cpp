// SPDX-License-Identifier: Apache-2.0
// Checks the declarations of a file: namespaces, constants, types, variables, shared functions.

#include "glb2idl/checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/schema/idl_word.h"
#include "glb2idl/initial.h"
#include "glb2idl/notes.h"
#include "glb2idl/pool_checker.h"
#include "glb2idl/text.h"
#include "glb2idl/types.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

class Checker {
 public:
  explicit Checker(Context& context) : context_(context), types_(context) {}

  void operator()(const ast::Include& /*unused*/) {}  // the compiler has already read it

  void operator()(const ast::Namespace& found) {
    constexpr std::size_t kLongest = 150;
    std::string scope;
    bool good = true;
    for (std::size_t i = 0; i < found.path.parts.size(); ++i) {
      const std::string& part = found.path.parts[i];
      if (scope.size() + part.size() > kLongest) {  // the rest would only make each name below longer
        context_.error(found.path.at, fmt::format("the namespace is longer than {} characters, shorten it", kLongest));
        break;
      }
      const ast::Name name{part, found.path.at};
      context_.current = scope;
      good = context_.check_name(name, NameRole::Namespace) && good;
      if (i != 0 && lower(found.path.parts[i - 1]) == lower(part)) {
        context_.error(name.at,
                       fmt::format("a namespace inside '{}' cannot have the same name in IDL, rename it", part));
      }
      scope = qualified(scope, part);
      const bool known = namespaces_known(scope);
      if (good && context_.declare(name, Symbol::Kind::Namespace) && !known) {
        context_.scope.claim_idl(scope, name.at, false);
        context_.program_namespaces.insert(scope);
      }
    }
    context_.current = scope;
  }

  void operator()(const ast::Define& found) {
    auto value = context_.evaluate(found.value);
    if (value && value->kind == Value::Kind::Duration) {
      context_.error(found.value.at, "a time is not a constant, write it where it is used");
      value.reset();
    }
    add_constant(found.name, std::move(value), std::nullopt, found.description, true);
  }

  void operator()(const ast::Pool& found) { check_pool(context_, types_, found.declaration); }

  void operator()(const ast::Declaration& found) {
    switch (found.kind) {
      case ast::Declaration::Kind::Typedef:
        return type_alias(found);
      case ast::Declaration::Kind::Constant:
        return constants(found);
      case ast::Declaration::Kind::Plain:
        return plain(found);
    }
  }

 private:
  [[nodiscard]] bool namespaces_known(const std::string& scope) const {
    return context_.program_namespaces.contains(scope);
  }

  // ---- constants

  void add_constant(const ast::Name& name, std::optional<Value> value, std::optional<Base> base,
                    const std::string& description, bool is_define) {
    if (!context_.check_name(name, NameRole::Constant) || !value) {
      context_.declare(name, Symbol::Kind::Broken);
      return;
    }
    Symbol symbol;
    symbol.kind = Symbol::Kind::Constant;
    symbol.at = name.at;
    symbol.value = *value;
    symbol.is_define = is_define;
    const std::string full_name = context_.full(name.text);
    if (context_.scope.declare(full_name, std::move(symbol)) &&
        context_.scope.claim_cpp("#define ", full_name, name.at)) {  // a macro in the header for C
      context_.add(Constant{full_name, std::move(*value), base, description});
    }
  }

  void constants(const ast::Declaration& found) {
    const auto type = types_.resolve(found.type, "", found.description);
    for (const ast::Declarator& declarator : found.declarators) {
      constant(found, declarator, type);
    }
  }

  void constant(const ast::Declaration& found, const ast::Declarator& declarator,
                const std::optional<schema::Type>& type) {
    const auto broken = [&](std::string text) {
      if (!text.empty()) {
        context_.error(declarator.name.at, std::move(text));
      }
      context_.declare(declarator.name, Symbol::Kind::Broken);
    };
    if (!type) {
      return broken("");
    }
    if (declarator.is_function || !declarator.initial) {
      return broken("a constant needs a value: const int32_t NAME = 5;");
    }
    auto whole = types_.with_dims(*type, declarator);
    if (!whole) {
      return broken("");
    }
    if (!whole->dims.empty() || whole->base == Base::Struct || !declarator.initial->value) {
      return broken("a constant is one number or text, use a variable with initial values for more");
    }
    const Notes notes =
        read_notes(context_, found.annotations, declarator.annotations, *whole, NoteTarget::Other, found.description);
    auto value = context_.evaluate(*declarator.initial->value);
    if (value) {
      if (const auto why = convert(*value, *whole)) {
        context_.error(declarator.initial->at, *why);
        value.reset();
      }
    }
    add_constant(declarator.name, std::move(value), whole->base, notes.description, false);
  }

  // ---- types

  void type_alias(const ast::Declaration& found) {
    const bool has_body = found.type.structure || found.type.enumeration;
    const bool names_body =
        has_body && !found.type.tag && !found.declarators.empty() && found.declarators[0].dims.empty();
    const auto type = names_body
                          ? types_.define(found.type, found.declarators[0].name, found.description)
                          : types_.resolve(found.type, found.declarators.empty() ? "" : found.declarators[0].name.text,
                                           found.description);
    for (std::size_t i = names_body ? 1 : 0; i < found.declarators.size(); ++i) {
      alias(found, found.declarators[i], type);
    }
  }

  void alias(const ast::Declaration& found, const ast::Declarator& declarator,
             const std::optional<schema::Type>& type) {
    const ast::Name& name = declarator.name;
    const std::string full_name = context_.full(name.text);
    auto whole = type ? types_.with_dims(*type, declarator) : std::nullopt;
    if (whole && whole->name == full_name && declarator.dims.empty()) {
      return;  // typedef struct P {...} P;
    }
    if (declarator.initial || declarator.is_function) {
      context_.error(name.at, "a typedef only gives a type another name, remove the rest");
      whole.reset();
    }
    if (!context_.check_name(name, NameRole::Type) || !whole || !count_parts(context_, *whole, name.at)) {
      context_.declare(name, Symbol::Kind::Broken);
      return;
    }
    (void)read_notes(context_, found.annotations, declarator.annotations, *whole, NoteTarget::Other, "");
    Symbol symbol;
    symbol.kind = Symbol::Kind::Type;
    symbol.at = name.at;
    symbol.type = *whole;
    if (context_.scope.declare(full_name, std::move(symbol))) {
      context_.add(Alias{full_name, std::move(*whole)});
    }
  }

  // ---- variables and functions

  void plain(const ast::Declaration& found) {
    const bool function = !found.declarators.empty() && found.declarators[0].is_function;
    std::optional<schema::Type> type;
    if (function && found.type.kind == ast::TypeSpec::Kind::Void) {
      type.emplace();
      type->base = Base::Struct;
    } else if (function && (found.type.structure || found.type.enumeration)) {
      context_.error(found.type.at, "declare the type of the result before the function");
    } else {
      type = types_.resolve(found.type, found.declarators.empty() ? "" : found.declarators[0].name.text,
                            found.description);
    }
    for (const ast::Declarator& declarator : found.declarators) {
      if (declarator.is_function) {
        shared_function(found, declarator, type);
      } else if (type && is_void(*type)) {
        context_.error(declarator.name.at, "a variable cannot be void, give it a type");
      } else {
        variable(found, declarator, type);
      }
    }
    if (found.declarators.empty() && !found.annotations.empty()) {
      (void)read_notes(context_, found.annotations, {}, type.value_or(schema::Type{}), NoteTarget::Other, "");
    }
  }

  // Declares the name; returns false if anything about it is wrong.
  bool declare(const ast::Name& name, NameRole role, bool good) {
    const auto kind = role == NameRole::Variable ? Symbol::Kind::Variable : Symbol::Kind::Function;
    const bool usable = context_.check_name(name, role) && good;
    return context_.declare(name, usable ? kind : Symbol::Kind::Broken) && usable;
  }

  void variable(const ast::Declaration& found, const ast::Declarator& declarator,
                const std::optional<schema::Type>& type) {
    const ast::Name& name = declarator.name;
    auto whole = type ? types_.with_dims(*type, declarator) : std::nullopt;
    if (!declare(name, NameRole::Variable, whole.has_value())) {
      return;
    }
    schema::Variable result;
    result.name = context_.full(name.text);
    if (!context_.scope.claim_variable(result.name, name.at) ||
        !context_.scope.claim_cpp("var_", result.name, name.at) ||
        (is_wrapped(*whole) && !context_.scope.claim_idl(result.name + "_", name.at, true)) ||
        !count_parts(context_, *whole, name.at)) {
      return;
    }
    Notes notes = read_notes(context_, found.annotations, declarator.annotations, *whole, NoteTarget::Variable,
                             found.description);
    result.kind = whole->dims.empty() && schema::size_of(whole->base) != 0 ? abi::Kind::Scalar : abi::Kind::Ring;
    result.type_hash = schema::hash_of(*whole);
    result.unit = std::move(notes.unit);
    result.description = std::move(notes.description);
    result.range = notes.range;
    result.alarms = std::move(notes.alarms);
    result.retain = notes.retain;
    result.view = notes.view;
    result.optional = notes.optional;
    result.maxage_ns = notes.maxage_ns;
    result.source = context_.source(name);
    if (declarator.initial) {
      result.initial = bytes(*whole, *declarator.initial, notes.range);
      result.given = true;
      if (std::all_of(result.initial.begin(), result.initial.end(), [](std::uint8_t b) { return b == 0; })) {
        result.initial.clear();  // memory is already 0
      }
    } else if (notes.range && (notes.range->min > 0 || notes.range->max < 0)) {
      context_.error(
          name.at,
          fmt::format("without an initial value '{}' is 0, which is outside of its @range, give it one", name.text));
    }
    if (notes.fallback != nullptr) {
      result.fallback = bytes(*whole, *notes.fallback, notes.range);
    }
    result.type = std::move(*whole);
    context_.add(std::move(result));
  }

  std::vector<std::uint8_t> bytes(const schema::Type& type, const ast::Initializer& from,
                                  const std::optional<schema::Range>& range) {
    auto found = initial_bytes(context_, type, from, range);
    context_.total_initial += found ? found->size() : 0;
    if (context_.total_initial > kMaxTotalInitialBytes) {
      context_.error(from.at, fmt::format("all initial values together are larger than {} MiB, set some in start()",
                                          kMaxTotalInitialBytes >> 20U));
      return {};
    }
    return found ? std::move(*found) : std::vector<std::uint8_t>();
  }

  void shared_function(const ast::Declaration& found, const ast::Declarator& declarator,
                       const std::optional<schema::Type>& result_type) {
    const ast::Name& name = declarator.name;
    schema::Function result;
    result.name = context_.full(name.text);
    bool good = result_type && parameters(declarator, result);
    if (result_type && result_type->size() > kMaxCallBytes) {
      context_.error(name.at, fmt::format("a result has at most {} bytes, use a variable for more", kMaxCallBytes));
      good = false;
    }
    if (declarator.initial) {
      context_.error(declarator.initial->at, "a function has no value, remove it");
      good = false;
    }
    if (declarator.deadline) {
      const auto deadline = read_duration(context_, *declarator.deadline, "a deadline");
      good = good && deadline;
      result.deadline_ns = deadline.value_or(0);
    }
    const ast::Name arguments{name.text + "_args", name.at};
    if (!declare(name, NameRole::Function, good) || !context_.declare(arguments, Symbol::Kind::Taken) ||
        !context_.scope.claim_cpp("fn_", result.name, name.at) || !count_parts(context_, result.arguments, name.at) ||
        !count_parts(context_, *result_type, name.at)) {
      return;
    }
    const Notes notes = read_notes(context_, found.annotations, declarator.annotations, *result_type,
                                   NoteTarget::Function, found.description);
    result.description = notes.description;
    result.result = *result_type;
    result.source = context_.source(name);
    result.type_hash = schema::hash_of(result);
    context_.add(std::move(result));
  }

  bool parameters(const ast::Declarator& declarator, schema::Function& to) {
    schema::Type& type = to.arguments;
    type.base = Base::Struct;
    type.name = to.name + "_args";
    bool good = true;
    for (const ast::Parameter& parameter : declarator.parameters) {
      ast::Name name = parameter.declarator.name;
      if (name.text.empty()) {
        name = {fmt::format("arg{}", type.fields.size() + 1), parameter.type.at};
      }
      good = context_.check_name(name, NameRole::Parameter) && good;
      if (std::any_of(type.fields.begin(), type.fields.end(),
                      [&](const schema::Field& f) { return f.name == name.text; })) {
        context_.error(name.at, fmt::format("there is already a parameter '{}', choose another name", name.text));
        good = false;
      }
      if (parameter.type.structure || parameter.type.enumeration) {
        context_.error(parameter.type.at, "declare the type of a parameter before the function");
        good = false;
        continue;
      }
      const auto base = types_.resolve(parameter.type, "", "");
      auto whole = base ? types_.with_dims(*base, parameter.declarator) : std::nullopt;
      if (!whole) {
        good = false;
        continue;
      }
      schema::Field field;
      field.name = name.text;
      field.type = std::move(*whole);
      type.fields.push_back(std::move(field));
    }
    good = good && types_.lay_out(type, declarator.name.at);
    if (good && type.element_size > kMaxCallBytes) {
      context_.error(declarator.name.at,
                     fmt::format("the parameters have more than {} bytes, use a variable", kMaxCallBytes));
      return false;
    }
    return good;
  }

  Context& context_;
  TypeBuilder types_;
};

}  // namespace

void check_file(Context& context, const ast::File& file) {
  Checker checker(context);
  context.current.clear();
  context.broken = file.broken;
  for (const ast::Item& item : file.items) {
    std::visit(checker, item);
  }
}

void choose_idl_constants(Context& context) {
  for (GlbFile& unit : context.program.units) {
    for (Item& item : unit.items) {
      auto* constant = std::get_if<Constant>(&item);
      if (constant == nullptr || scope_of(constant->name).empty()) {
        continue;  // a C macro without prefix would change other texts
      }
      const std::string name(last_of(constant->name));
      const bool is_integer = constant->value.kind == Value::Kind::Integer && constant->value.enum_type.empty() &&
                              constant->value.integer != INT64_MIN;
      constant->in_idl =
          is_integer && !schema::is_idl_keyword(name) && !context.field_names.contains(mangled(constant->name)) &&
          context.scope.idl_is_free(constant->name) && context.scope.claim_idl(constant->name, Span{}, false);
    }
  }
}

}  // namespace indurop::glb2idl
