// SPDX-License-Identifier: Apache-2.0
// Shared variables, their value structs and arrays on a standard stream: std::cout << joints[0] prints
// {x: 1, y: 2, z: 3}, std::cout << joints prints [{x: ...}, ...]. Not real-time safe; see irp::printf for run().

#pragma once

#include <indurop/var.h>

#include <array>
#include <ostream>
#include <string_view>
#include <type_traits>

namespace indurop::detail {

struct IgnoreField {
  template <class T>
  constexpr void operator()(const char* /*name*/, const T& /*value*/) const noexcept {}
};

// A struct from a .glb file; glb2idl generates indurop_fields(value, f) with it.
template <class T>
concept ValueStruct = std::is_class_v<T> && requires(const T& value) {
  indurop_fields(value, IgnoreField{});
};

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

template <class T>
struct InnermostOf {
  using type = T;
};
template <class T, std::size_t N>
struct InnermostOf<std::array<T, N>> : InnermostOf<T> {};

template <class T>
void print_value(std::ostream& out, const T& value) {
  if constexpr (IsArray<T>::value) {
    out << '[';
    const char* separator = "";
    for (const auto& element : value) {
      out << separator;
      print_value(out, element);
      separator = ", ";
    }
    out << ']';
  } else if constexpr (ValueStruct<T>) {
    out << '{';
    const char* separator = "";
    indurop_fields(value, [&out, &separator](const char* name, const auto& field) {
      out << separator << name << ": ";
      print_value(out, field);
      separator = ", ";
    });
    out << '}';
  } else if constexpr (std::is_enum_v<T>) {
    out << static_cast<long long>(value);
  } else if constexpr (sizeof(T) == 1 && std::is_integral_v<T> && !std::is_same_v<T, char> &&
                       !std::is_same_v<T, bool>) {
    out << static_cast<int>(value);  // int8_t and uint8_t are numbers
  } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    out << '"' << std::string_view(value) << '"';
  } else {
    out << value;
  }
}

// Leaves and texts print like the C++ type that they represent.
template <class T>
concept WholeShape = Shape<T> &&(IsArray<typename T::whole_type>::value || ValueStruct<typename T::whole_type>);

template <class T>
concept PrintableValue = ValueStruct<T> ||(IsArray<T>::value&& ValueStruct<typename InnermostOf<T>::type>);

}  // namespace indurop::detail

namespace indurop {

template <detail::WholeShape T>
std::ostream& operator<<(std::ostream& out, const T& shape) {
  detail::print_value(out, shape.get());
  return out;
}

}  // namespace indurop

// In the global namespace, because a value struct lives in the namespace of its .glb file.
template <indurop::detail::PrintableValue T>
std::ostream& operator<<(std::ostream& out, const T& value) {
  indurop::detail::print_value(out, value);
  return out;
}
