// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/type_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/union_fields.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

constexpr std::uint64_t kMaxParts = std::uint64_t{16} << 20U;  // elements of one type
constexpr std::size_t kMaxDimensions = 16;
constexpr std::int64_t kMaxStringLength = 65'000;

bool is_whole(Elementary type) noexcept {
  return is_int(type) || (is_bit(type) && type != Elementary::Bool);
}

std::string whose(const std::string& name) {
  const std::string capitals = upper(name);
  if (capitals == "ANY" || capitals.starts_with("ANY_")) {
    return "; types of every kind are for inputs of functions, write a function block for each type you use";
  }
  if (capitals.starts_with("MC_")) {
    return "; the function blocks of PLCopen Motion Control are in motion.st of share/indurop/plc, name that file too";
  }
  if (capitals.starts_with("PYTHON_")) {
    return "; it is Python or C code of Beremiz, write a module of its own for that, with shared variables between";
  }
  return ", declare it";
}

class TypeBuilder {
 public:
  explicit TypeBuilder(Context& context) : context_(context), expressions_(context) {}

  const Type* build(ast::TypeSpec& spec, const std::string& name) {
    switch (spec.kind) {
      case ast::TypeSpec::Kind::Elementary:
        return context_.elementary(spec.elementary);
      case ast::TypeSpec::Kind::String:
        return string(spec);
      case ast::TypeSpec::Kind::Named:
        return named(spec);
      case ast::TypeSpec::Kind::Array:
        return array(spec);
      case ast::TypeSpec::Kind::Pointer:
        return pointer(spec);
      case ast::TypeSpec::Kind::Subrange:
        return subrange(spec, name);
      case ast::TypeSpec::Kind::Struct:
        return structure(spec, name);
      case ast::TypeSpec::Kind::Enum:
        return enumeration(spec, name);
      case ast::TypeSpec::Kind::Inferred:
        break;  // by the first assignment
    }
    return nullptr;
  }

 private:
  const Type* string(ast::TypeSpec& spec) {
    if (!spec.length) {
      return context_.elementary(spec.elementary);
    }
    const auto length = expressions_.constant(*spec.length, "the length of a text");
    if (!length) {
      return nullptr;
    }
    if (*length < 1 || *length > kMaxStringLength) {
      context_.error(spec.length->at,
                     fmt::format("a {} has 1 to {} characters", name_of(spec.elementary), kMaxStringLength));
      return nullptr;
    }
    return context_.program.types.text(spec.elementary, static_cast<std::size_t>(*length));
  }

  const Type* named(ast::TypeSpec& spec) {
    const auto found = context_.program.type_names.find(upper(spec.name));
    if (found != context_.program.type_names.end() && !spec.starts.empty() && found->second->pou == nullptr) {
      context_.error(spec.at, fmt::format("{} is no function block that FB_Init gives values to; write := after it",
                                          to_string(*found->second)));
      return nullptr;
    }
    if (found != context_.program.type_names.end()) {
      return found->second;
    }
    if (const Type* foreign = foreign_type_named(context_, spec.name)) {
      return foreign;
    }
    const std::string_view in_standard = name_in_standard(spec.name);
    if (!in_standard.empty() && find_block(in_standard) != nullptr) {
      spec.name = std::string(in_standard);
      return named(spec);
    }
    if (const LibraryBlock* block = find_block(spec.name)) {
      Type type;
      type.kind = Type::Kind::Block;
      type.name = block->name;
      type.block = block;
      const Type* added = context_.program.types.add(std::move(type));
      context_.program.type_names.emplace(upper(spec.name), added);
      return added;
    }
    if (context_.diagnostics.full()) {  // further errors are only counted
      context_.error(spec.at, fmt::format("there is no type and no function block '{}'", spec.name));
      return nullptr;
    }
    std::vector<std::string> known;
    bool has_motion = false;
    for (const auto& [one, type] : context_.program.type_names) {
      known.push_back(type->name);
      has_motion = has_motion || one.starts_with("MC_");
    }
    for (const LibraryBlock& block : library_blocks()) {
      known.push_back(block.name);
    }
    for (std::size_t i = 0; i < kElementaryCount; ++i) {
      known.emplace_back(name_of(static_cast<Elementary>(i)));
    }
    std::string hint = why_left_out(context_.program.project, spec.name);
    hint = hint.empty() && !has_motion && upper(spec.name).starts_with("MC_") ? whose(spec.name) : hint;
    hint = hint.empty() ? did_you_mean(context_, spec.name, known) : hint;
    context_.error(spec.at, fmt::format("there is no type and no function block '{}'{}", spec.name,
                                        hint.empty() ? whose(spec.name) : hint));
    return nullptr;
  }

  // The type may be declared later: close_pointers() finds it.
  const Type* pointer(ast::TypeSpec& spec) {
    Type type;
    type.kind = Type::Kind::Pointer;
    type.pointer = spec.pointer;
    if (!spec.element->starts.empty()) {
      context_.error(spec.element->at, "a pointer has no values for FB_Init, the instance it leads to has them");
      return nullptr;
    }
    const bool later = !context_.program.types_known && spec.element->kind == ast::TypeSpec::Kind::Named &&
                       !context_.program.type_names.contains(upper(spec.element->name));
    type.element = later ? nullptr : build(*spec.element, "");
    if (type.element == nullptr && !later) {
      return nullptr;
    }
    Type* added = context_.program.types.add(std::move(type));
    if (added->pointers > kMaxTypeNesting) {
      context_.error(spec.at, fmt::format("more than {} pointers that lead to each other, use fewer", kMaxTypeNesting));
      return nullptr;
    }
    if (later) {
      context_.program.open_pointers.emplace_back(added, spec.element.get());
    }
    return added;
  }

  const Type* array(ast::TypeSpec& spec) {
    Type type;
    type.kind = Type::Kind::Array;
    if (spec.dimensions.size() > kMaxDimensions) {
      context_.error(spec.at, fmt::format("an ARRAY of {} dimensions, at most {} are possible", spec.dimensions.size(),
                                          kMaxDimensions));
      return nullptr;
    }
    type.element = build(*spec.element, "");
    if (spec.open) {
      type.open = true;
      type.dimensions.resize(spec.dimensions.size());
      const bool nested = type.element != nullptr && type.element->kind == Type::Kind::Array;
      if (nested) {
        context_.error(spec.at, "ARRAY[*] OF ARRAY, use ARRAY[*, *]");
      }
      return type.element == nullptr || nested ? nullptr : context_.program.types.add(std::move(type));
    }
    for (ast::Dimension& one : spec.dimensions) {
      const auto bounds = range(one, "a bound of an array");
      if (!bounds || type.element == nullptr) {
        return nullptr;
      }
      type.dimensions.push_back(*bounds);
    }
    if (type.element->open) {
      context_.error(spec.at, kOpenArray);
      return nullptr;
    }
    if (type.element->kind == Type::Kind::Array) {  // ARRAY OF ARRAY is indexed a[i][j]; that is what it stays
      const bool deep =
          type.element->element->kind == Type::Kind::Array && type.element->element->element->kind == Type::Kind::Array;
      if (deep) {
        context_.error(spec.at, "arrays more than 3 levels deep, use ARRAY[a..b, c..d] or a STRUCT");
        return nullptr;
      }
    }
    if (parts_of(type) > kMaxParts) {
      context_.error(spec.at, fmt::format("more than {} elements, use a smaller array", kMaxParts));
      return nullptr;
    }
    const Type* added = context_.program.types.add(std::move(type));
    return added->depth <= kMaxTypeNesting || is_limited(spec.at, *added) ? added : nullptr;
  }

  std::optional<Bounds> range(ast::Dimension& dimension, std::string_view what) {
    const auto low = expressions_.constant(dimension.low, what);
    const auto high = expressions_.constant(dimension.high, what);
    if (!low || !high) {
      return std::nullopt;
    }
    constexpr auto kMaxBound = std::numeric_limits<std::int32_t>::max();
    if (*low > *high || *low < -kMaxBound || *high > kMaxBound) {
      context_.error(dimension.low.at,
                     fmt::format("{}..{} is not a range, write the smaller bound first", *low, *high));
      return std::nullopt;
    }
    return Bounds{*low, *high};
  }

  const Type* subrange(ast::TypeSpec& spec, const std::string& name) {
    if (!is_whole(spec.elementary)) {
      context_.error(spec.at, fmt::format("{} has no ranges, use a type of whole numbers", name_of(spec.elementary)));
      return nullptr;
    }
    const auto bounds = range(*spec.range, "a bound of a range");
    if (!bounds) {
      return nullptr;
    }
    Type type = *context_.elementary(spec.elementary);
    if (!fits(Integer{bounds->low}, type) || !fits(Integer{bounds->high}, type)) {
      context_.error(spec.at,
                     fmt::format("{} does not hold {}..{}", name_of(spec.elementary), bounds->low, bounds->high));
      return nullptr;
    }
    type.range = *bounds;
    type.name = name;
    return context_.program.types.add(std::move(type));
  }

  const Type* structure(ast::TypeSpec& spec, const std::string& name) {
    if (name.empty()) {
      context_.error(spec.at, fmt::format("a {} needs a name, declare it between TYPE and END_TYPE",
                                          spec.overlaps ? "UNION" : "STRUCT"));
      return nullptr;
    }
    Type type;
    type.kind = Type::Kind::Struct;
    type.overlaps = spec.overlaps;
    type.name = name;
    bool fine = context_.program.fields <= kMaxFields && (!spec.element || inherit(spec, type));
    std::set<std::string> names;
    for (const Field& field : type.fields) {
      names.insert(upper(field.name));
    }
    for (ast::Variable& field : spec.fields) {
      if (!names.insert(upper(field.name)).second) {
        context_.error(field.at, fmt::format("the field '{}' is declared twice, rename one of them", field.name));
        continue;
      }
      const Type* one = build(field.type, "");
      fine = fine && one != nullptr;
      if (one == nullptr) {
        continue;
      }
      if (one->open) {
        context_.error(field.at, kOpenArray);
        fine = false;
      }
      if (const std::string why = spec.overlaps ? why_no_overlap(*one) : "";
          !why.empty() || (spec.overlaps && field.initial)) {
        context_.error(
            field.at, why.empty() ? "a field of a UNION has no initial value, because the others have its place" : why);
      }
      const bool valid = !field.initial || expressions_.initials().initial(*field.initial, *one);
      type.fields.push_back({field.name, one, valid && field.initial ? &*field.initial : nullptr, field.comment});
    }
    if (type.fields.empty() && fine && context_.codesys()) {
      context_.warning(spec.at,
                       fmt::format("{} has no fields; variables of it, or that contain it, are not shared", name));
    } else if (type.fields.empty() && fine) {
      context_.error(spec.at, "a STRUCT needs at least one field");
      fine = false;
    }
    if (!fine) {
      return nullptr;
    }
    Type* added = context_.program.types.add(std::move(type));
    if (!is_limited(spec.at, *added)) {
      return nullptr;
    }
    context_.program.named_types.push_back(added);
    return added;
  }

  // Returns whether it is within the limits, else reports an error.
  bool is_limited(const Place& at, const Type& type) {
    if (type.depth > kMaxTypeNesting) {
      context_.error(at,
                     fmt::format("structures and arrays more than {} levels deep, make them flatter", kMaxTypeNesting));
    } else if (type.fields_inside > kMaxFieldsInside) {
      context_.error(at, fmt::format("{} has more than {} fields with those of its inner structures, use arrays",
                                     type.name, kMaxFieldsInside));
    } else if (type.parts > kMaxParts) {
      context_.error(at,
                     fmt::format("{} has more than {} elements in its arrays, use smaller ones", type.name, kMaxParts));
    } else {
      return count_fields(context_, at, type);
    }
    return false;
  }

  // Adds the fields of the STRUCT it extends, before its own.
  bool inherit(ast::TypeSpec& spec, Type& type) {
    const Type* base = build(*spec.element, "");
    if (base != nullptr && (base->kind != Type::Kind::Struct || base->overlaps || spec.overlaps)) {
      context_.error(spec.element->at, fmt::format("{} is no STRUCT that could be extended", to_string(*base)));
      return false;
    }
    if (base != nullptr && base->extends == kMaxExtends) {
      context_.error(spec.element->at,
                     fmt::format("{} is the last of more than {} structures that extend each other, use fewer",
                                 type.name, kMaxExtends));
    } else if (base != nullptr) {
      type.fields = base->fields;
      type.extends = base->extends + 1;
    }
    return base != nullptr;
  }

  const Type* enumeration(ast::TypeSpec& spec, const std::string& name) {
    Type type;
    type.kind = Type::Kind::Enum;
    type.elementary = is_whole(spec.elementary) ? spec.elementary : Elementary::Int;
    type.name = name.empty() ? free_type_name() : name;
    std::int64_t next = 0;
    bool fine = true;
    std::set<std::string> names;
    for (ast::EnumValue& one : spec.values) {
      if (one.value) {
        const auto number = expressions_.constant(*one.value, "the value of an enumeration");
        fine = fine && number.has_value();
        next = number.value_or(next);
      }
      if (!names.insert(upper(one.name)).second) {
        context_.error(one.at, fmt::format("the value '{}' is declared twice, rename one of them", one.name));
        continue;
      }
      if (!fits(Integer{next}, *context_.elementary(type.elementary))) {
        context_.error(one.at, fmt::format("{} does not fit {}", next, name_of(type.elementary)));
        fine = false;
      }
      type.items.push_back({one.name, next++});
    }
    if (!fine) {
      return nullptr;
    }
    Type* added = context_.program.types.add(std::move(type));
    context_.program.named_types.push_back(added);
    if (name.empty()) {
      context_.program.type_names.emplace(upper(added->name), added);
    }
    return added;
  }

  // Returns a name for an enumeration that is declared where it is used: mode : (Off, On);
  std::string free_type_name() {
    const std::string begin = context_.pou != nullptr ? context_.pou->name + "_values" : "values";
    std::size_t& last = context_.type_numbers[begin];
    std::string name;
    do {
      ++last;
      name = last == 1 ? begin : fmt::format("{}_{}", begin, last);
    } while (context_.program.type_names.contains(upper(name)) || context_.declared_types.contains(upper(name)));
    return name;
  }

  Context& context_;
  ExpressionChecker expressions_;
};

}  // namespace

const Type* build_type(Context& context, ast::TypeSpec& spec, const std::string& name) {
  return TypeBuilder(context).build(spec, name);
}

}  // namespace indurop::plc
