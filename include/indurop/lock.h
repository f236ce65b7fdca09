// SPDX-License-Identifier: Apache-2.0
// Several changes as one commit: with `auto v = lock(joints); v[0].x = 1; v[1].x = 2;` readers see all changes at once
// when the scope ends, and none of them if the module throws or dies before.

#pragma once

#include <indurop/var.h>

#include <algorithm>
#include <array>
#include <exception>
#include <tuple>
#include <utility>

extern "C" {
// Throws std::runtime_error naming the variable whose lock was not free in time.
[[noreturn]] void indurop_lock_fault(const char* variable);
}

namespace indurop {

// The unpublished next version of a variable. No other writer can commit while it lives; readers keep seeing the
// previous version. Real-time safe; keep the scope short.
template <class T>
class Locked {
 public:
  Locked(abi::RingHeader* ring, void* version) noexcept
      : ring_(ring), value_(static_cast<T*>(version)), exceptions_(std::uncaught_exceptions()) {}
  Locked(Locked&& other) noexcept
      : ring_(std::exchange(other.ring_, nullptr)), value_(other.value_), exceptions_(other.exceptions_) {}
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  Locked& operator=(Locked&&) = delete;
  ~Locked() {
    if (ring_ == nullptr) {
      return;
    }
    if (std::uncaught_exceptions() > exceptions_) {
      indurop_abort_write(ring_);
    } else {
      indurop_commit_write(ring_);
    }
  }

  T& operator*() const noexcept { return *value_; }
  T* operator->() const noexcept { return value_; }
  decltype(auto) operator[](std::size_t index) const { return value_->at(index); }
  // Discards the changes; the variable keeps its version.
  void discard() noexcept { indurop_abort_write(std::exchange(ring_, nullptr)); }

 private:
  abi::RingHeader* ring_;
  T* value_;
  int exceptions_;
};

namespace detail {
struct Pending {
  abi::RingHeader* ring;
  void* version;
  const char* name;
};

template <class... Variable, std::size_t... I>
std::tuple<Locked<typename Variable::whole_type>...> adopt(const std::array<Pending, sizeof...(Variable)>& pending,
                                                           std::index_sequence<I...> /*unused*/) noexcept {
  return {Locked<typename Variable::whole_type>(pending[I].ring, pending[I].version)...};
}
}  // namespace detail

// Locks one or several whole variables, always in the same order, so two modules cannot deadlock. One variable returns
// a Locked, several return a tuple for a structured binding. Scalars are atomics: use +=, modify() or put them into a
// struct. Errors: throws std::runtime_error if a lock is not free within 5 ms (its holder is stopped) or is already
// held by the caller.
template <class... Variable>
requires(sizeof...(Variable) > 0 && (detail::Shape<Variable> && ...))
    [[nodiscard]] auto lock(const Variable&... /*variables*/) {
  static_assert(((Variable::tag_type::kKind == abi::Kind::Ring) && ...),
                "a scalar is an atomic and has no lock: use +=, modify(), or put it into a struct");
  static_assert(((sizeof(typename Variable::whole_type) == Variable::tag_type::kSize) && ...),
                "lock whole variables, not parts of them");
  (detail::record_access<typename Variable::tag_type, detail::kRead | detail::kWrite>(), ...);
  constexpr std::size_t kCount = sizeof...(Variable);
  std::array<detail::Pending, kCount> pending{
      detail::Pending{detail::ring_of<typename Variable::tag_type>(), nullptr, Variable::tag_type::ref().name}...};
  std::array<detail::Pending*, kCount> order{};
  for (std::size_t i = 0; i < kCount; ++i) {
    order[i] = &pending[i];
  }
  std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->ring < b->ring; });
  for (std::size_t i = 0; i < kCount; ++i) {
    order[i]->version = indurop_begin_edit(order[i]->ring);
    if (order[i]->version == nullptr) {
      for (std::size_t k = 0; k < i; ++k) {
        indurop_abort_write(order[k]->ring);
      }
      indurop_lock_fault(order[i]->name);
    }
  }
  if constexpr (kCount == 1) {
    using Only = std::tuple_element_t<0, std::tuple<Variable...>>;
    return Locked<typename Only::whole_type>(pending[0].ring, pending[0].version);
  } else {
    return detail::adopt<Variable...>(pending, std::index_sequence_for<Variable...>{});
  }
}

}  // namespace indurop
