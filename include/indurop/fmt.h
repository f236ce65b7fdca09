// SPDX-License-Identifier: Apache-2.0
// Shared variables and their value structs in the fmt library: fmt::print("{} {:.3f}\n", joints[0], joints[0].x).
// The only InduRoP header that needs fmt; include it where it is used. Not real-time safe.

#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <indurop/print.h>

namespace indurop::detail {

template <class T>
concept ScalarShape = Shape<T> && std::is_arithmetic_v<typename T::whole_type>;
template <class T>
concept EnumShape = Shape<T> && std::is_enum_v<typename T::whole_type>;
template <class T>
struct IsText : std::false_type {};
template <std::size_t N>
struct IsText<string<N>> : std::true_type {};
template <class T>
concept TextShape = Shape<T> && IsText<typename T::whole_type>::value;

template <class Out, class T>
Out format_value(Out out, const T& value) {
  if constexpr (IsArray<T>::value) {
    const char* separator = "[";
    for (const auto& element : value) {
      out = format_value(fmt::format_to(out, "{}", separator), element);
      separator = ", ";
    }
    return fmt::format_to(out, "]");
  } else if constexpr (ValueStruct<T>) {
    const char* separator = "{";
    indurop_fields(value, [&out, &separator](const char* name, const auto& field) {
      out = format_value(fmt::format_to(out, "{}{}: ", separator, name), field);
      separator = ", ";
    });
    return fmt::format_to(out, "}}");
  } else if constexpr (std::is_enum_v<T>) {
    return fmt::format_to(out, "{}", static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (IsText<T>::value) {
    return fmt::format_to(out, "\"{}\"", value.view());
  } else {
    return fmt::format_to(out, "{}", value);
  }
}

// For types that accept no format specification of their own.
struct PlainFormatter {
  constexpr auto parse(fmt::format_parse_context& context) { return context.begin(); }
};

}  // namespace indurop::detail

template <indurop::detail::ScalarShape T>
struct fmt::formatter<T> : fmt::formatter<typename T::whole_type> {
  template <class Context>
  auto format(const T& shape, Context& context) const {
    return fmt::formatter<typename T::whole_type>::format(shape.get(), context);
  }
};

template <indurop::detail::EnumShape T>
struct fmt::formatter<T> : fmt::formatter<std::underlying_type_t<typename T::whole_type>> {
  template <class Context>
  auto format(const T& shape, Context& context) const {
    using Number = std::underlying_type_t<typename T::whole_type>;
    return fmt::formatter<Number>::format(static_cast<Number>(shape.get()), context);
  }
};

template <std::size_t N>
struct fmt::formatter<indurop::string<N>> : fmt::formatter<fmt::string_view> {
  template <class Context>
  auto format(const indurop::string<N>& text, Context& context) const {
    return fmt::formatter<fmt::string_view>::format({text.data, text.size()}, context);
  }
};

template <indurop::detail::TextShape T>
struct fmt::formatter<T> : fmt::formatter<fmt::string_view> {
  template <class Context>
  auto format(const T& shape, Context& context) const {
    const auto text = shape.get();
    return fmt::formatter<fmt::string_view>::format({text.data, text.size()}, context);
  }
};

template <indurop::detail::WholeShape T>
struct fmt::formatter<T> : indurop::detail::PlainFormatter {
  template <class Context>
  auto format(const T& shape, Context& context) const {
    return indurop::detail::format_value(context.out(), shape.get());
  }
};

template <indurop::detail::ValueStruct T>
struct fmt::formatter<T> : indurop::detail::PlainFormatter {
  template <class Context>
  auto format(const T& value, Context& context) const {
    return indurop::detail::format_value(context.out(), value);
  }
};

// ArrayRef has begin() and end(), and a string converts to a view: fmt must not format either of them as a range.
template <indurop::detail::Shape T>
struct fmt::is_range<T, char> : std::false_type {};
