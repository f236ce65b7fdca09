// SPDX-License-Identifier: Apache-2.0
// Several variables read together: `auto s = snapshot(pose, speed);` returns copies of both as they were after the same
// tick of the board that writes them.

#pragma once

#include <indurop/var.h>

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace indurop {

// Copies of whole variables in the order they were named: s.get<0>(), or `const auto& [pose, speed] = s;`.
template <class... Value>
class Snapshot {
 public:
  // Returns false if the values could not be read together: a part of the board's update was lost in transmission, or
  // it is being written without a pause. Each single value is consistent all the same.
  [[nodiscard]] bool coherent() const noexcept { return coherent_; }
  template <std::size_t I>
  [[nodiscard]] const auto& get() const noexcept {
    return std::get<I>(values_);
  }

  [[nodiscard]] const std::tuple<Value...>& values() const noexcept { return values_; }

  Snapshot() = default;
  template <std::size_t... I>
  void take(std::array<abi::Piece, sizeof...(Value)> pieces, std::index_sequence<I...> /*unused*/) noexcept {
    ((pieces[I].to = &std::get<I>(values_)), ...);
    coherent_ = indurop_read_together(pieces.data(), static_cast<std::uint32_t>(pieces.size()));
  }

 private:
  std::tuple<Value...> values_;
  bool coherent_ = false;
};

// Reads whole variables together. Real-time safe: no lock, no system call; retries for some microseconds at most.
template <class... Variable>
requires(sizeof...(Variable) > 0 && (detail::Shape<Variable> && ...))
    [[nodiscard]] auto snapshot(const Variable&... /*variables*/) noexcept {
  static_assert(((sizeof(typename Variable::whole_type) == Variable::tag_type::kSize) && ...),
                "take whole variables, not parts of them");
  (detail::record_access<typename Variable::tag_type, detail::kRead>(), ...);
  Snapshot<typename Variable::whole_type...> snapshot;
  snapshot.take({abi::Piece{Variable::tag_type::ref().entry, nullptr, Variable::tag_type::kKind,
                            Variable::tag_type::kSize, 0, 0, 0}...},
                std::index_sequence_for<Variable...>{});
  return snapshot;
}

}  // namespace indurop

template <class... Value>
struct std::tuple_size<indurop::Snapshot<Value...>> : std::integral_constant<std::size_t, sizeof...(Value)> {};
template <std::size_t I, class... Value>
struct std::tuple_element<I, indurop::Snapshot<Value...>> : std::tuple_element<I, std::tuple<const Value...>> {};
