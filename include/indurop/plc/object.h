// SPDX-License-Identifier: Apache-2.0
// Object orientation of the third edition: the base of function blocks with methods, variables of an INTERFACE, and
// calls whose target is known only at run time. Real-time safe, except for the faults.

#pragma once

#include <indurop/plc/fault.h>
#include <indurop/plc/pointer.h>
#include <indurop/plc/scan.h>

#include <cstdint>
#include <type_traits>

namespace indurop::iec {

// The common base of all function blocks with methods. It comes first, so that a block which extends another begins
// with that block's variables.
struct Instance {
  Instance() = default;
  Instance(const Instance&) = default;
  Instance& operator=(const Instance&) = default;
  virtual ~Instance() = default;
  virtual void operator()(const Scan& /*scan*/) {}  // a CLASS has no body
};

// A variable of an INTERFACE: NULL, or an instance that has its methods.
template <class T>
struct Interface {
  T* object = nullptr;

  Interface() = default;
  Interface(T& instance) noexcept
      : object(&instance) {}  // NOLINT(google-explicit-constructor): as the language converts
  template <class U>
  Interface(const Interface<U>& other) noexcept  // NOLINT(google-explicit-constructor): as the language converts
      : object(other.object) {}
};

// Returns whether both refer to the same instance, through whatever interfaces.
template <class A, class B>
bool operator==(const Interface<A>& a, const Interface<B>& b) noexcept {
  const void* const one = a.object == nullptr ? nullptr : dynamic_cast<const void*>(a.object);
  const void* const other = b.object == nullptr ? nullptr : dynamic_cast<const void*>(b.object);
  return one == other;
}

// The instance whose method is called.
template <class T>
T& called(Place place, const Interface<T>& variable) {
  if (variable.object == nullptr) [[unlikely]] {
    fail(place, "a method of an interface variable that is NULL is called");
  }
  return *variable.object;
}

namespace detail {

template <class T>
T* instance_of(Place /*place*/, const Interface<T>& variable) noexcept {
  return variable.object;
}
template <class T>
T* instance_of(Place place, const Pointer<T>& pointer) {
  return pointer.base == nullptr ? nullptr : &deref(place, pointer);
}
template <class T>
void lead_to(Interface<T>& variable, T* instance) noexcept {
  variable.object = instance;
}
template <class T>
void lead_to(Pointer<T>& pointer, T* instance) noexcept {
  pointer = instance == nullptr ? Pointer<T>{} : address(*instance, *instance);
}

}  // namespace detail

// to ?= from: NULL unless the instance is of the type that `to` refers to.
template <class To, class From>
void attempt(Place place, To& to, const From& from) {
  using Wanted = std::remove_pointer_t<decltype(detail::instance_of(place, to))>;
  auto* const instance = detail::instance_of(place, from);
  detail::lead_to(to, instance == nullptr ? nullptr : dynamic_cast<Wanted*>(instance));
  if constexpr (requires { to.call = from.call; }) {
    to.call = from.call;
  }
}

// A call of a method whose target the text does not determine: through an interface, or of a function block that
// extends another. Such calls may recurse.
class Call {
 public:
  Call(int& inside, Place place) : inside_(inside) {
    constexpr int kMaxDepth = 100;
    if (inside_ >= kMaxDepth) [[unlikely]] {
      fail(place, "more than 100 calls of methods inside each other (recursion)");
    }
    const auto here = reinterpret_cast<std::intptr_t>(this);
    if (inside_ == 0) {
      outermost = here;
    } else if (outermost - here > kMaxStack) [[unlikely]] {
      fail(place, "calls of methods inside each other need more than 128 KiB of the stack (recursion)");
    }
    ++inside_;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  ~Call() { --inside_; }

 private:
  static constexpr std::intptr_t kMaxStack = std::intptr_t{128} * 1024;
  [[gnu::visibility("hidden")]] inline static std::intptr_t outermost = 0;  // each module has its own

  int& inside_;
};

}  // namespace indurop::iec
