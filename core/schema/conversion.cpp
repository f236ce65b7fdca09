// SPDX-License-Identifier: Apache-2.0
#include "core/schema/conversion.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::schema {
namespace {

bool is_plain_number(Base base) noexcept {
  return base != Base::Text && base != Base::Enum && base != Base::Struct;
}

const Field* field_of(const Type& type, const std::string& name) {
  const auto found =
      std::find_if(type.fields.begin(), type.fields.end(), [&name](const Field& one) { return one.name == name; });
  return found != type.fields.end() ? &*found : nullptr;
}

class Declarations {
 public:
  void part(const std::string& name, const Type& from, const std::string& was_unit, const Type& to,
            const std::string& is_unit) {
    const bool shorter =
        from.dims.size() == to.dims.size() &&
        std::mismatch(from.dims.begin(), from.dims.end(), to.dims.begin(), [](std::uint32_t was, std::uint32_t is) {
          return was <= is;
        }).first != from.dims.end();
    if (was_unit != is_unit) {
      lost(name, fmt::format("its unit was '{}', is '{}'", was_unit, is_unit));
    } else if (from.dims.size() != to.dims.size() ||
               (from.base != to.base && !(is_plain_number(from.base) && is_plain_number(to.base)))) {
      lost(name, fmt::format("was {}, is {}", display_name(from), display_name(to)));
    } else {
      if (shorter) {
        lost(name, fmt::format("was {}, is {}: it has fewer elements", display_name(from), display_name(to)));
      }
      compatible(name, from, to);
    }
  }

  Conversion take() { return std::move(result_); }

 private:
  void lost(const std::string& name, const std::string& why) { result_.lost.push_back(name + ": " + why); }

  void compatible(const std::string& name, const Type& from, const Type& to) {
    if (from.base == Base::Struct) {
      fields(name + (from.dims.empty() ? "" : "[]"), from, to);
    } else {
      result_.carried.push_back(name);
    }
  }

  void fields(const std::string& name, const Type& from, const Type& to) {
    for (const Field& is : to.fields) {
      const std::string inner = name + "." + is.name;
      if (const Field* const was = field_of(from, is.name); was != nullptr) {
        part(inner, was->type, was->unit, is.type, is.unit);
      } else {
        result_.added.push_back(inner);
      }
    }
    for (const Field& was : from.fields) {
      if (field_of(to, was.name) == nullptr) {
        lost(name + "." + was.name, "is no longer declared");
      }
    }
  }

  Conversion result_;
};

}  // namespace

Conversion convert(const Variable& from, const Variable& to) {
  Declarations all;
  all.part(from.name, from.type, from.unit, to.type, to.unit);
  return all.take();
}

}  // namespace indurop::schema
