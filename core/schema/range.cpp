// SPDX-License-Identifier: Apache-2.0
// Checks that the numbers of a value are inside their declared ranges.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/schema/leaf.h"

namespace indurop::schema {
namespace {

bool unlimited(const Range& range) noexcept {
  return std::isinf(range.min) && range.min < 0 && std::isinf(range.max) && range.max > 0;
}

class Checker {
 public:
  // Returns false at the first number outside; `message` then names it.
  bool value(const Range& range, const Type& type, std::size_t dim, const std::uint8_t* at, const std::string& path) {
    if (type.base != Base::Struct && unlimited(range)) {
      return true;
    }
    if (dim < type.dims.size()) {
      const std::uint64_t stride = stride_of(type, dim);
      for (std::uint32_t i = 0; i < type.dims[dim]; ++i) {
        if (!value(range, type, dim + 1, at + i * stride, fmt::format("{}[{}]", path, i))) {
          return false;
        }
      }
      return true;
    }
    if (type.base == Base::Struct) {
      return std::all_of(type.fields.begin(), type.fields.end(), [&](const Field& field) {
        const std::string name = path.empty() ? field.name : path + "." + field.name;
        return value(field.range.value_or(range), field.type, 0, at + field.offset, name);
      });
    }
    return number(range, type.base, at, path);
  }

  std::string message;

 private:
  bool number(const Range& range, Base base, const std::uint8_t* at, const std::string& path) {
    // The machine decides if plain char is signed; the range shows what was intended.
    const Base shown = base != Base::Char ? base : range.min < 0 ? Base::Int8 : Base::UInt8;
    bool inside = true;
    with_number(shown, at, [&](auto value) {
      // Can hold every 64-bit integer; the check is false for NaN.
      const auto wide = static_cast<long double>(value);
      inside = wide >= static_cast<long double>(range.min) && wide <= static_cast<long double>(range.max);
      if (!inside) {
        message = fmt::format("{}{}{} is outside {}..{}", path, path.empty() ? "" : ": ", value, range.min, range.max);
      }
    });
    return inside;
  }
};

}  // namespace

Result<void, Failure> check_range(const Range& range, const Type& type, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < type.size()) {
    return Failure{Errc::InvalidArgument, "the value is shorter than its type"};
  }
  Checker checker;
  if (!checker.value(range, type, 0, bytes.data(), "")) {
    return Failure{Errc::OutOfRange, std::move(checker.message)};
  }
  return {};
}

}  // namespace indurop::schema
