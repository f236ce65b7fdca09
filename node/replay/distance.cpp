// SPDX-License-Identifier: Apache-2.0
#include "node/replay/distance.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "core/schema/leaf.h"

namespace indurop::node {
namespace {

using schema::Base;
using schema::Type;

class Measurement {
 public:
  explicit Measurement(const std::uint8_t* begin) : begin_(begin) {}

  void value(const Type& type, std::size_t dim, const std::uint8_t* a, const std::uint8_t* b) {
    if (std::memcmp(a, b, size_from(type, dim)) == 0) {
      return;
    }
    if (dim < type.dims.size()) {
      const std::uint64_t stride = schema::stride_of(type, dim);
      for (std::uint32_t i = 0; i < type.dims[dim]; ++i) {
        value(type, dim + 1, a + i * stride, b + i * stride);
      }
    } else if (type.base == Base::Struct) {
      for (const schema::Field& field : type.fields) {
        value(field.type, 0, a + field.offset, b + field.offset);
      }
    } else {
      note(type.base == Base::Text ? between_texts(type, a, b) : between_numbers(type.base, a, b), a);
    }
  }

  [[nodiscard]] double largest() const noexcept { return largest_; }
  [[nodiscard]] std::optional<std::uint32_t> offset() const noexcept { return offset_; }

 private:
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  static std::uint64_t size_from(const Type& type, std::size_t dim) noexcept {
    return dim == 0 ? type.size() : schema::stride_of(type, dim - 1);
  }

  static double between_texts(const Type& type, const std::uint8_t* a, const std::uint8_t* b) noexcept {
    const auto text = [&type](const std::uint8_t* at) {
      const auto* const begin = reinterpret_cast<const char*>(at);
      return std::string_view(begin, ::strnlen(begin, type.text_size));
    };
    return text(a) == text(b) ? 0 : kInfinite;
  }

  // long double has room for every 64-bit integer.
  static double between_numbers(Base base, const std::uint8_t* a, const std::uint8_t* b) noexcept {
    const auto x = schema::as_number<long double>(base, a);
    const auto y = schema::as_number<long double>(base, b);
    const double apart = x && y ? static_cast<double>(std::fabs(*x - *y)) : kInfinite;
    return std::isnan(apart) ? kInfinite : apart;
  }

  void note(double apart, const std::uint8_t* at) noexcept {
    if (!offset_ || apart > largest_) {
      largest_ = apart;
      offset_ = static_cast<std::uint32_t>(at - begin_);
    }
  }

  const std::uint8_t* begin_;
  double largest_ = 0;
  std::optional<std::uint32_t> offset_;
};

}  // namespace

Distance distance(const schema::Variable& variable, std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  Measurement measurement(a.data());
  measurement.value(variable.type, 0, a.data(), b.data());
  return {measurement.largest(),
          measurement.offset() ? schema::part_at(variable, *measurement.offset()).name : variable.name};
}

}  // namespace indurop::node
