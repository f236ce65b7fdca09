// SPDX-License-Identifier: Apache-2.0
// Include it before code of ours whose atomics shall be those of the model: std::atomic, fences, and GCC's built-in
// functions. What comes from elsewhere (the standard library, GoogleTest) has to be included before it.

#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tests/support/weak_memory/model.h"

namespace indurop::test::weak {

template <class T>
std::uint64_t to_bits(const T& value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  return bits;
}
template <class T>
T from_bits(std::uint64_t bits) {
  T value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

template <class T>
T load_as(const T* place, int order) {
  return from_bits<T>(load(place, sizeof(T), order));
}
template <class T>
void store_as(T* place, std::type_identity_t<T> value, int order) {
  store(place, to_bits(value), sizeof(T), order);
}
template <class T>
bool compare_exchange_as(T* place, T* expected, std::type_identity_t<T> wanted, int order, int failed) {
  const std::uint64_t hoped = to_bits(*expected);
  const std::uint64_t before = modify(place, sizeof(T), order, failed, [&](std::uint64_t& value) {
    if (value != hoped) {
      return false;
    }
    value = to_bits(wanted);
    return true;
  });
  *expected = from_bits<T>(before);
  return before == hoped;
}

constexpr int number_of(std::memory_order order) {
  return static_cast<int>(order);
}
// A failed comparison only reads.
constexpr std::memory_order without_release(std::memory_order order) {
  return order == std::memory_order_acq_rel   ? std::memory_order_acquire
         : order == std::memory_order_release ? std::memory_order_relaxed
                                              : order;
}

template <class T>
class ModelAtomic {
 public:
  static constexpr bool is_always_lock_free = true;
  using value_type = T;

  constexpr ModelAtomic() noexcept = default;
  constexpr ModelAtomic(T value) noexcept : value_(value) {}  // NOLINT(google-explicit-constructor): as std::atomic
  ModelAtomic(const ModelAtomic&) = delete;
  ModelAtomic& operator=(const ModelAtomic&) = delete;

  [[nodiscard]] T load(std::memory_order order = std::memory_order_seq_cst) const noexcept {
    return load_as(&value_, number_of(order));
  }
  void store(T value, std::memory_order order = std::memory_order_seq_cst) noexcept {
    store_as(&value_, value, number_of(order));
  }
  T exchange(T value, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return change([value](T) { return value; }, order);
  }
  T fetch_add(T by, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return change([by](T before) { return static_cast<T>(before + by); }, order);
  }
  T fetch_sub(T by, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return change([by](T before) { return static_cast<T>(before - by); }, order);
  }
  T fetch_or(T by, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return change([by](T before) { return static_cast<T>(before | by); }, order);
  }
  T fetch_and(T by, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return change([by](T before) { return static_cast<T>(before & by); }, order);
  }
  bool compare_exchange_strong(T& expected, T wanted, std::memory_order order, std::memory_order failed) noexcept {
    return compare_exchange_as(&value_, &expected, wanted, number_of(order), number_of(failed));
  }
  bool compare_exchange_strong(T& expected, T wanted, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return compare_exchange_strong(expected, wanted, order, without_release(order));
  }
  bool compare_exchange_weak(T& expected, T wanted, std::memory_order order, std::memory_order failed) noexcept {
    return compare_exchange_strong(expected, wanted, order, failed);
  }
  bool compare_exchange_weak(T& expected, T wanted, std::memory_order order = std::memory_order_seq_cst) noexcept {
    return compare_exchange_strong(expected, wanted, order);
  }
  operator T() const noexcept { return load(); }  // NOLINT(google-explicit-constructor): as std::atomic
  T operator=(T value) noexcept {                 // NOLINT(misc-unconventional-assign-operator): as std::atomic
    store(value);
    return value;
  }

 private:
  template <class Change>
  T change(Change by, std::memory_order order) noexcept {
    return from_bits<T>(modify(&value_, sizeof(T), number_of(order), number_of(order), [&](std::uint64_t& bits) {
      bits = to_bits(by(from_bits<T>(bits)));
      return true;
    }));
  }

  T value_{};
};

inline void model_fence(std::memory_order order) noexcept {
  fence(number_of(order));
}

}  // namespace indurop::test::weak

// NOLINTBEGIN(cert-dcl58-cpp): what stands for std::atomic has to be found there
namespace std {
using indurop::test::weak::model_fence;
using indurop::test::weak::ModelAtomic;
}  // namespace std
// NOLINTEND(cert-dcl58-cpp)

// NOLINTBEGIN(cppcoreguidelines-macro-usage,bugprone-reserved-identifier): the code under test is not changed
#define atomic ModelAtomic
#define atomic_thread_fence model_fence
#define __atomic_load_n(place, order) indurop::test::weak::load_as(place, order)
#define __atomic_store_n(place, value, order) indurop::test::weak::store_as(place, value, order)
#define __atomic_load(place, to, order) (*(to) = indurop::test::weak::load_as(place, order))
#define __atomic_store(place, value, order) indurop::test::weak::store_as(place, *(value), order)
#define __atomic_compare_exchange(place, expected, wanted, may_fail, order, failed) \
  indurop::test::weak::compare_exchange_as(place, expected, *(wanted), order, failed)
// Values are copied byte by byte with atomics then.
#ifndef __SANITIZE_THREAD__
#define __SANITIZE_THREAD__
#endif
// NOLINTEND(cppcoreguidelines-macro-usage,bugprone-reserved-identifier)
