// SPDX-License-Identifier: Apache-2.0
// Converts initial values to bytes.

#include "glb2idl/initial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace indurop::glb2idl {
namespace {

using schema::Base;
using Bytes = std::vector<std::uint8_t>;

std::optional<std::string> convert_enum(Value& value, const schema::Type& type) {
  if (!value.enum_type.empty() && value.enum_type != type.name) {
    return fmt::format("this is a value of {}, not of {}", value.enum_type, type.name);
  }
  const bool known = value.kind == Value::Kind::Integer &&
                     std::any_of(type.enumerators.begin(), type.enumerators.end(),
                                 [&](const schema::Enumerator& e) { return e.value == value.integer; });
  if (!known) {
    return fmt::format("{} is not a value of {}, use one of its names", to_text(value), type.name);
  }
  return std::nullopt;
}

std::optional<std::string> convert_real(Value& value, bool is_float) {
  double real = value.as_double();
  if (is_float) {
    if (std::fabs(real) > static_cast<double>(std::numeric_limits<float>::max())) {
      return fmt::format("{} does not fit a float, use double", to_text(value));
    }
    real = static_cast<double>(static_cast<float>(real));
  }
  value.kind = Value::Kind::Real;
  value.real = real;
  return std::nullopt;
}

class Filler {
 public:
  Filler(Context& context, Bytes& bytes) : context_(context), bytes_(bytes) {}

  // Fills the part of `type` below its first `level` dimensions.
  bool fill(const schema::Type& type, std::size_t level, const ast::Initializer& from, std::uint64_t at,
            const std::optional<schema::Range>& range) {
    if (level < type.dims.size()) {
      return fill_array(type, level, from, at, range);
    }
    if (type.base == Base::Struct) {
      return fill_struct(type, from, at);
    }
    if (!from.value) {
      if (from.list.size() == 1 && from.list[0].value) {
        return fill(type, level, from.list[0], at, range);  // {5} for 5
      }
      if (from.list.empty()) {
        return true;  // {} is zero
      }
      return fail(from.at,
                  fmt::format("expected one value for {}, found a list of {}", describe(type), from.list.size()));
    }
    auto value = context_.evaluate(*from.value);
    if (!value) {
      return false;
    }
    if (const auto why = convert(*value, type)) {
      return fail(from.at, *why);
    }
    if (range && value->is_number() && (value->as_double() < range->min || value->as_double() > range->max)) {
      return fail(from.at, fmt::format("{} is outside of its @range({}, {}), correct one of them", to_text(*value),
                                       range->min, range->max));
    }
    put(type, *value, at);
    return true;
  }

 private:
  bool fail(Span at, std::string text) {
    context_.error(at, std::move(text));
    return false;
  }
  static std::string describe(const schema::Type& type) {
    schema::Type element = type;
    element.dims.clear();
    return schema::display_name(element);
  }

  bool fill_array(const schema::Type& type, std::size_t level, const ast::Initializer& from, std::uint64_t at,
                  const std::optional<schema::Range>& range) {
    const std::uint32_t count = type.dims[level];
    if (from.value) {
      return fail(from.at, fmt::format("expected a list of up to {} values in braces, such as {{ ... }}", count));
    }
    if (from.list.size() > count) {
      return fail(from.list[count].at,
                  fmt::format("the array has room for {} value{}, remove the rest", count, count == 1 ? "" : "s"));
    }
    std::uint64_t stride = type.element_size;
    for (std::size_t i = level + 1; i < type.dims.size(); ++i) {
      stride *= type.dims[i];
    }
    bool good = true;
    for (std::size_t i = 0; i < from.list.size(); ++i) {
      good = fill(type, level + 1, from.list[i], at + i * stride, range) && good;
    }
    return good;
  }

  bool fill_struct(const schema::Type& type, const ast::Initializer& from, std::uint64_t at) {
    if (from.value) {
      return fail(from.at, fmt::format("expected the values of {} in braces, such as {{ ... }}", type.name));
    }
    if (from.list.size() > type.fields.size()) {
      return fail(from.list[type.fields.size()].at,
                  fmt::format("{} has {} field{}, remove the rest", type.name, type.fields.size(),
                              type.fields.size() == 1 ? "" : "s"));
    }
    bool good = true;
    for (std::size_t i = 0; i < from.list.size(); ++i) {
      const schema::Field& field = type.fields[i];
      good = fill(field.type, 0, from.list[i], at + field.offset, field.range) && good;
    }
    return good;
  }

  template <class T>
  void put_as(T value, std::uint64_t at) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }

  void put(const schema::Type& type, const Value& value, std::uint64_t at) {
    switch (type.base) {
      case Base::Float:
        return put_as(static_cast<float>(value.real), at);
      case Base::Double:
        return put_as(value.real, at);
      case Base::Text:
        std::memcpy(bytes_.data() + at, value.text.data(), value.text.size());
        return;
      case Base::Bool:
      case Base::Char:
      case Base::Int8:
      case Base::UInt8:
        return put_as(static_cast<std::uint8_t>(value.integer), at);
      case Base::Int16:
      case Base::UInt16:
        return put_as(static_cast<std::uint16_t>(value.integer), at);
      case Base::Int32:
      case Base::UInt32:
      case Base::Enum:
        return put_as(static_cast<std::uint32_t>(value.integer), at);
      case Base::Int64:
      case Base::UInt64:
        return put_as(static_cast<std::uint64_t>(value.integer), at);
      case Base::Struct:
        return;
    }
  }

  Context& context_;
  Bytes& bytes_;
};

}  // namespace

std::optional<Limits> limits_of(Base base) noexcept {
  switch (base) {
    case Base::Bool:
      return Limits{0, 1};
    case Base::Char:  // signed on some boards, unsigned on others
      return Limits{0, INT8_MAX};
    case Base::Int8:
      return Limits{INT8_MIN, INT8_MAX};
    case Base::UInt8:
      return Limits{0, UINT8_MAX};
    case Base::Int16:
      return Limits{INT16_MIN, INT16_MAX};
    case Base::UInt16:
      return Limits{0, UINT16_MAX};
    case Base::Int32:
    case Base::Enum:
      return Limits{INT32_MIN, INT32_MAX};
    case Base::UInt32:
      return Limits{0, UINT32_MAX};
    case Base::Int64:
      return Limits{INT64_MIN, INT64_MAX};
    case Base::UInt64:
      return Limits{0, UINT64_MAX};
    case Base::Float:
    case Base::Double:
    case Base::Text:
    case Base::Struct:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<std::string> convert(Value& value, const schema::Type& type) {
  if (type.base == Base::Text) {
    if (value.kind != Value::Kind::Text) {
      return fmt::format("{} is not a text, write it in quotes", to_text(value));
    }
    if (value.text.size() >= type.text_size) {
      return fmt::format("this text has {} bytes but char[{}] holds at most {}, shorten it or enlarge the array",
                         value.text.size(), type.text_size, type.text_size - 1);
    }
    return std::nullopt;
  }
  if (!value.is_number()) {
    return fmt::format("{} is not a number, {} needs one", value.kind == Value::Kind::Text ? "a text" : "a time",
                       schema::display_name(type));
  }
  if (type.base == Base::Enum) {
    return convert_enum(value, type);
  }
  value.enum_type.clear();
  const auto limits = limits_of(type.base);
  if (!limits) {
    return convert_real(value, type.base == Base::Float);
  }
  if (value.kind == Value::Kind::Real) {
    constexpr double kExact = 9e15;
    if (value.real != std::floor(value.real) || std::fabs(value.real) > kExact) {
      return fmt::format("{} is not a whole number, {} needs one", to_text(value), schema::display_name(type));
    }
    value.integer = static_cast<Wide>(value.real);
  }
  if (value.integer < limits->min || value.integer > limits->max) {
    return fmt::format("{} does not fit {} ({} to {}), use {}", to_text(value.integer), schema::display_name(type),
                       to_text(limits->min), to_text(limits->max),
                       type.base == Base::Char ? "int8_t or uint8_t: char has a sign on some boards only"
                                               : "a larger type or another value");
  }
  value.kind = type.base == Base::Bool ? Value::Kind::Bool : Value::Kind::Integer;
  return std::nullopt;
}

std::optional<Bytes> initial_bytes(Context& context, const schema::Type& type, const ast::Initializer& initializer,
                                   const std::optional<schema::Range>& range) {
  if (type.size() > kMaxInitialBytes) {
    context.error(initializer.at,
                  fmt::format("a variable of {} bytes is too large for values here (limit {}), set them in start()",
                              type.size(), kMaxInitialBytes));
    return std::nullopt;
  }
  Bytes bytes(type.size());
  if (!Filler(context, bytes).fill(type, 0, initializer, 0, range)) {
    return std::nullopt;
  }
  return bytes;
}

}  // namespace indurop::glb2idl
