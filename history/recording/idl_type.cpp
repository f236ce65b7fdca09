// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_type.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "history/recording/idl_reader.h"
#include "history/recording/records.h"

namespace indurop::recording {
namespace {

using schema::Base;
using schema::Type;

constexpr std::size_t kMaxTypes = 16'384;  // a definition may be used any number of times

constexpr std::uint32_t rounded_up(std::uint64_t at, std::uint32_t align) {
  return static_cast<std::uint32_t>((at + align - 1) / align * align);
}

class TypeMaker {
 public:
  explicit TypeMaker(const IdlDefinitions& definitions) : definitions_(definitions) {}

  // Each function returns false for what it does not understand or what is too large.
  bool of_name(const std::string& name, std::uint64_t bound, int depth, Type& type) {
    constexpr std::array<std::string_view, 12> kNumbers{"boolean", "char",   "int8",  "uint8",  "int16", "uint16",
                                                        "int32",   "uint32", "int64", "uint64", "float", "double"};
    if (++made_ > kMaxTypes || depth > kMaxIdlDepth) {
      return false;
    }
    if (const auto* const number = std::find(kNumbers.begin(), kNumbers.end(), name); number != kNumbers.end()) {
      return of_size(static_cast<Base>(number - kNumbers.begin()), type);
    }
    if (name == "string") {
      type.base = Base::Text;
      type.text_size = type.element_size = static_cast<std::uint32_t>(std::min(bound, kMaxMessageBytes) + 1);
      return bound != 0 && bound < kMaxMessageBytes;
    }
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) {
      return false;
    }
    type.name = name;
    return found->second.is_enum ? of_enum(found->second, type) : of_struct(found->second, depth, type);
  }

  bool of_member(const IdlMember& member, int depth, Type& type) {
    if (!of_name(member.type, member.bound, depth, type)) {
      return false;
    }
    for (const std::uint64_t dim : member.dims) {
      if (dim == 0 || dim > kMaxMessageBytes) {
        return false;
      }
      type.dims.push_back(static_cast<std::uint32_t>(dim));
    }
    return type.size() <= kMaxMessageBytes;
  }

 private:
  static bool of_size(Base base, Type& type) {
    type.base = base;
    type.element_size = type.align = schema::size_of(base);
    return true;
  }

  static bool of_enum(const IdlDefinition& definition, Type& type) {
    for (const IdlEnumerator& each : definition.enumerators) {
      if (each.value > std::numeric_limits<std::int32_t>::max()) {
        return false;
      }
      type.enumerators.push_back({each.name, each.value});
    }
    return of_size(Base::Enum, type) && !type.enumerators.empty();
  }

  bool of_struct(const IdlDefinition& definition, int depth, Type& type) {
    type.base = Base::Struct;
    std::uint64_t end = 0;
    for (const IdlMember& member : definition.members) {
      schema::Field field;
      field.name = member.name;
      if (!of_member(member, depth + 1, field.type)) {
        return false;
      }
      field.offset = rounded_up(end, field.type.align);
      end = field.offset + field.type.size();
      type.align = std::max(type.align, field.type.align);
      type.fields.push_back(std::move(field));
      if (end > kMaxMessageBytes) {
        return false;
      }
    }
    type.element_size = rounded_up(end, type.align);
    return end != 0;
  }

  const IdlDefinitions& definitions_;
  std::size_t made_ = 0;
};

}  // namespace

Result<Type, base::Problem> idl_type(std::string_view text, std::string_view name) {
  const auto definitions = read_idl(text);
  if (!definitions) {
    return base::Problem{fmt::format("the definition of {} is not understood", name)};
  }
  const std::string full(name);
  const auto found = definitions->find(full);
  TypeMaker maker(*definitions);
  Type type;
  const bool wraps = found != definitions->end() && is_wrapper(full, found->second);
  if (wraps ? !maker.of_member(found->second.members[0], 0, type) : !maker.of_name(full, 0, 0, type)) {
    return base::Problem{
        fmt::format("{} is too large, not defined, or of types that shared variables do not have", name)};
  }
  return type;
}

}  // namespace indurop::recording
