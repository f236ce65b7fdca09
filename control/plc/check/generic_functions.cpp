// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/generic_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "control/plc/check/pou_checker.h"
#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

constexpr std::array<std::string_view, 13> kGenerics{
    "ANY",          "ANY_ELEMENTARY", "ANY_MAGNITUDE", "ANY_NUM",  "ANY_REAL", "ANY_INT",  "ANY_SIGNED",
    "ANY_UNSIGNED", "ANY_BIT",        "ANY_STRING",    "ANY_DATE", "ANY_CHAR", "ANY_CHARS"};

// Returns the declaration of the type; none for types without a name.
std::optional<ast::TypeSpec> spec_of(const Type& type, const Place& at) {
  if (!type.name.empty() && (type.kind <= Type::Kind::Struct)) {
    return make::type(at, type.name);
  }
  if (type.kind != Type::Kind::Elementary) {
    return std::nullopt;
  }
  ast::TypeSpec out = make::type(at, type.elementary);
  if (type.is_text()) {
    out.kind = ast::TypeSpec::Kind::String;
    ast::Expression length;
    length.at = at;
    length.value = std::uint64_t{type.length};
    out.length = std::move(length);
  }
  return out;
}

// "INT", "STRING_20"
std::string word_of(const Type& type) {
  return type.is_text() ? fmt::format("{}_{}", name_of(type.elementary), type.length) : to_string(type);
}

bool replace(ast::TypeSpec& spec, const std::map<std::string, const Type*>& types) {
  const auto found = types.find(generic_name(spec));
  if (found == types.end()) {
    return generic_name(spec).empty();
  }
  const auto made = spec_of(*found->second, spec.at);
  if (made) {
    spec = *made;
  }
  return made.has_value();
}

}  // namespace

std::string generic_name(const ast::TypeSpec& type) {
  const std::string name = type.kind == ast::TypeSpec::Kind::Named ? upper(type.name) : std::string();
  return std::find(kGenerics.begin(), kGenerics.end(), name) != kGenerics.end() ? name : std::string();
}

bool is_generic(const ast::Pou& tree) noexcept {
  return tree.kind == ast::Pou::Kind::Function &&
         std::any_of(tree.variables.begin(), tree.variables.end(), [](const ast::Variable& one) {
           return one.section == ast::Section::Input && !generic_name(one.type).empty();
         });
}

bool generic_takes(const std::string& generic, const Type& type) noexcept {
  if (generic == "ANY") {
    return type.kind <= Type::Kind::Struct;
  }
  const Elementary own = type.elementary;
  const bool time = own == Elementary::Time;
  if (type.kind != Type::Kind::Elementary) {
    return false;
  }
  return generic == "ANY_ELEMENTARY" || (generic == "ANY_MAGNITUDE" && (is_num(own) || time)) ||
         (generic == "ANY_NUM" && is_num(own)) || (generic == "ANY_REAL" && is_real(own)) ||
         (generic == "ANY_INT" && is_int(own)) || (generic == "ANY_SIGNED" && is_signed_int(own)) ||
         (generic == "ANY_UNSIGNED" && is_unsigned_int(own)) || (generic == "ANY_BIT" && is_bit(own)) ||
         ((generic == "ANY_STRING" || generic == "ANY_CHARS") && type.is_text()) ||
         ((generic == "ANY_CHAR" || generic == "ANY_CHARS") && is_character(own)) ||
         (generic == "ANY_DATE" && is_date(own));
}

Pou* function_for(Context& context, const ast::Pou& tree, const std::map<std::string, const Type*>& types,
                  const Place& at) {
  Program& program = context.program;
  std::string name = tree.name + "_of";
  for (const auto& [generic, type] : types) {
    name += "_" + word_of(*type);
  }
  if (const auto known = program.pou_names.find(upper(name)); known != program.pou_names.end()) {
    const bool made_here = std::any_of(program.made_functions.begin(), program.made_functions.end(),
                                       [&](const ast::Pou& one) { return &one == known->second->tree; });
    if (!made_here) {
      context.error(at,
                    fmt::format("{} for these types is called {}, rename the other one of this name", tree.name, name));
    }
    return made_here ? known->second : nullptr;
  }
  ast::Pou made = tree;
  made.name = name;
  bool fine = !made.result || replace(*made.result, types);
  for (ast::Variable& one : made.variables) {
    fine = replace(one.type, types) && fine;
  }
  if (!fine) {
    context.error(at, fmt::format("of {} not all types are known from its inputs; arrays and instances are none of "
                                  "them, and each ANY_... needs an input that is given",
                                  tree.name));
    return nullptr;
  }
  const auto result_name = [&](ast::Expression& one) {  // the function assigns its result by its own name
    if (one.kind == ast::Expression::Kind::Name && same_name(one.name, tree.name)) {
      one.name = name;
    }
  };
  ast::each_expression(made.body, result_name);
  return &declare_further(context, program.made_functions.emplace_back(std::move(made)));
}

void warn_about_uncalled(Context& context) {
  for (const auto& [name, tree] : context.program.generic_functions) {
    const std::string begin = upper(tree->name) + "_OF_";
    const auto& made = context.program.made_functions;
    if (std::none_of(made.begin(), made.end(),
                     [&](const ast::Pou& one) { return upper(one.name).starts_with(begin); })) {
      context.warning(tree->at, fmt::format("{} is never called, so its body was not checked", tree->name));
    }
  }
}

}  // namespace indurop::plc
