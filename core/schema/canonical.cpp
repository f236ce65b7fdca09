// SPDX-License-Identifier: Apache-2.0
// Type model: sizes, names, the canonical text and its hash.

#include <fmt/format.h>

#include <array>
#include <iterator>

#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

struct BaseInfo {
  const char* c_name;
  const char* canonical;
  std::uint32_t size;
};
// In the order of Base.
constexpr std::array<BaseInfo, 15> kBases{{{"bool", "bool", 1},
                                           {"char", "char", 1},
                                           {"int8_t", "i8", 1},
                                           {"uint8_t", "u8", 1},
                                           {"int16_t", "i16", 2},
                                           {"uint16_t", "u16", 2},
                                           {"int32_t", "i32", 4},
                                           {"uint32_t", "u32", 4},
                                           {"int64_t", "i64", 8},
                                           {"uint64_t", "u64", 8},
                                           {"float", "f32", 4},
                                           {"double", "f64", 8},
                                           {"char", "text", 0},
                                           {"enum", "enum", 4},
                                           {"struct", "struct", 0}}};
static_assert(kBases.size() == static_cast<std::size_t>(Base::Struct) + 1);

const BaseInfo& info(Base base) noexcept {
  return kBases[static_cast<std::size_t>(base)];
}

void append_canonical(std::string& out, const Type& type) {
  auto to = std::back_inserter(out);
  out += info(type.base).canonical;
  if (type.base == Base::Text) {
    fmt::format_to(to, "({})", type.text_size);
  } else if (type.base == Base::Enum) {
    out += '{';
    for (const Enumerator& e : type.enumerators) {
      fmt::format_to(to, "{}{}={}", out.back() == '{' ? "" : ",", e.name, e.value);
    }
    out += '}';
  } else if (type.base == Base::Struct) {
    fmt::format_to(to, "({},{}){{", type.element_size, type.align);
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      fmt::format_to(to, "{}{}@{}:", i == 0 ? "" : ",", type.fields[i].name, type.fields[i].offset);
      append_canonical(out, type.fields[i].type);
    }
    out += '}';
  }
  for (const std::uint32_t dim : type.dims) {
    fmt::format_to(to, "[{}]", dim);
  }
}

std::uint64_t hash_text(const std::string& text) noexcept {
  return abi::fnv1a64(text.data(), text.size());
}

}  // namespace

std::uint64_t Type::size() const noexcept {
  std::uint64_t total = element_size;
  for (const std::uint32_t dim : dims) {
    if (__builtin_mul_overflow(total, std::uint64_t{dim}, &total)) {
      return UINT64_MAX;
    }
  }
  return total;
}

std::uint32_t size_of(Base base) noexcept {
  return info(base).size;
}
const char* name_of(Base base) noexcept {
  return info(base).c_name;
}

std::string canonical(const Type& type) {
  std::string out;
  append_canonical(out, type);
  return out;
}

std::uint64_t hash_of(const Type& type) {
  return hash_text(canonical(type));
}

std::uint64_t hash_of(const Function& function) {
  const bool is_void = function.result.base == Base::Struct && function.result.fields.empty();
  return hash_text(canonical(function.arguments) + "->" + (is_void ? std::string("void") : canonical(function.result)));
}

std::string display_name(const Type& type) {
  std::string out = type.name.empty() ? name_of(type.base) : type.name;
  for (const std::uint32_t dim : type.dims) {
    fmt::format_to(std::back_inserter(out), "[{}]", dim);
  }
  if (type.base == Base::Text) {
    fmt::format_to(std::back_inserter(out), "[{}]", type.text_size);
  }
  return out;
}

}  // namespace indurop::schema
