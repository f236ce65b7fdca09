// SPDX-License-Identifier: Apache-2.0
// Shared functions: declared in a .glb file, implemented in one module, called like a function from any module of the
// board, whether thread or process. Arguments and result travel through call slots in shared memory.
//   INDUROP_IMPLEMENT(knu::Robot::add, &my_add)                 // the module that implements it
//   double sum = add(1.0, 2.0);                                 // any other module; throws if there is no answer
//   if (auto r = add.within(2ms)(1.0, 2.0); r.ok()) use(r.value());

#pragma once

#include <indurop/detail/call.h>
#include <indurop/detail/mark.h>
#include <indurop/result.h>

#include <chrono>
#include <cstring>
#include <exception>
#include <optional>
#include <type_traits>
#include <utility>

namespace indurop {

// The time a call waits for its result if neither the .glb file nor the caller sets a deadline.
inline constexpr std::chrono::nanoseconds kDefaultCallDeadline{std::chrono::milliseconds(100)};

// Thrown when the result of a failed call is used, or when the caller did not check whether it failed.
class [[gnu::visibility("default")]] call_error : public std::exception {  // NOLINT: named like the standard's own
 public:
  call_error(const char* function, Errc code) noexcept;
  call_error(const call_error&) noexcept = default;
  call_error& operator=(const call_error&) noexcept = default;
  ~call_error() override;
  // "knu::Robot::add: no module implements it"
  [[nodiscard]] const char* what() const noexcept override;
  [[nodiscard]] Errc code() const noexcept {
    return code_;
  }

 private:
  Errc code_;
  char text_[160] = {};
};

namespace detail {

// The part of a Call that does not depend on the result's type.
class CallOutcome {
 public:
  CallOutcome(const char* function, Errc code) noexcept : function_(function), code_(code) {}
  CallOutcome(CallOutcome&& other) noexcept
      : function_(other.function_), code_(other.code_), seen_(std::exchange(other.seen_, true)) {}
  CallOutcome(const CallOutcome&) = delete;
  CallOutcome& operator=(const CallOutcome&) = delete;
  CallOutcome& operator=(CallOutcome&&) = delete;
  ~CallOutcome() noexcept(false) {
    if (!seen_ && code_ != Errc::Ok && std::uncaught_exceptions() == 0) {
      indurop_call_fault(function_, static_cast<int>(code_));
    }
  }

  [[nodiscard]] bool ok() const noexcept { return error() == Errc::Ok; }
  // NotFound     no module implements it, the node does not know it, or there is no node
  // Busy         all its call slots are in use
  // Dead         the process that implements it died
  // Timeout      no result within the deadline
  // Failed       the implementation threw
  // TypeMismatch caller and node were built from different .glb files
  [[nodiscard]] Errc error() const noexcept {
    seen_ = true;
    return code_;
  }

 protected:
  void require() const {
    if (!ok()) {
      indurop_call_fault(function_, static_cast<int>(code_));
    }
  }

 private:
  const char* function_;
  Errc code_;
  mutable bool seen_ = false;
};

}  // namespace detail

// The return value of a call of a shared function. Converts to the result; throws call_error if there is none, and also
// if it is destroyed without a call of ok() or error(): no failure goes unnoticed.
template <class R>
class Call : public detail::CallOutcome {
 public:
  Call(const char* function, Errc code, const R& value) noexcept : CallOutcome(function, code), value_(value) {}
  [[nodiscard]] const R& value() const {
    require();
    return value_;
  }
  operator R() const { return value(); }  // NOLINT(google-explicit-constructor): used like the result

 private:
  R value_;
};

template <>
class Call<void> : public detail::CallOutcome {
 public:
  using CallOutcome::CallOutcome;
  void value() const { require(); }
};

// A shared function. Calling it passes the arguments to the module that implements it and waits for the result, at most
// until the deadline. Real-time safe in the sense that it neither allocates nor locks, but it does wait: choose a
// deadline that fits the caller's period. Any thread of any process.
template <class Tag, class Signature>
class Function;

template <class Tag, class R, class... Argument>
class Function<Tag, R(Argument...)> {
 public:
  using tag_type = Tag;

  class WithDeadline {
   public:
    constexpr explicit WithDeadline(std::chrono::nanoseconds deadline) noexcept : deadline_(deadline) {}
    Call<R> operator()(const Argument&... arguments) const noexcept { return call(deadline_.count(), arguments...); }

   private:
    std::chrono::nanoseconds deadline_;
  };

  Call<R> operator()(const Argument&... arguments) const noexcept {
    return call(Tag::kDeadlineNs > 0 ? Tag::kDeadlineNs : kDefaultCallDeadline.count(), arguments...);
  }
  // The same function with another deadline: add.within(2ms)(1.0, 2.0).
  [[nodiscard]] constexpr WithDeadline within(std::chrono::nanoseconds deadline) const noexcept {
    return WithDeadline(deadline);
  }

 private:
  static Call<R> call(std::int64_t deadline_ns, const Argument&... arguments) noexcept {
    using Args = typename Tag::args;
    const Args packed{arguments...};
    detail::CallRequest request{Tag::kNameHash, Tag::kTypeHash, &packed, nullptr, detail::packed_size<Args>(), 0,
                                deadline_ns};
    if constexpr (std::is_void_v<R>) {
      return Call<void>(Tag::kName, static_cast<Errc>(indurop_call(&request)));
    } else {
      R result{};
      request.result = &result;
      request.result_size = sizeof(R);
      const auto code = static_cast<Errc>(indurop_call(&request));
      return Call<R>(Tag::kName, code, result);
    }
  }
};

namespace detail {

// One object per INDUROP_IMPLEMENT: offers the function for as long as its module is loaded.
template <class Shared, auto Code>
class Implementation {
 public:
  Implementation() noexcept : offer_{} {
    offer_.name_hash = Tag::kNameHash;
    offer_.type_hash = Tag::kTypeHash;
    offer_.name = Tag::kName;
    offer_.args_size = packed_size<Args>();
    if constexpr (!std::is_void_v<Result>) {
      offer_.result_size = sizeof(Result);
    }
    offer_.invoke = &invoke;
    indurop_offer_function(&offer_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() { indurop_withdraw_function(&offer_); }

 private:
  using Tag = typename Shared::tag_type;
  using Args = typename Tag::args;
  using Result = typename Tag::result;

  // The arguments are in shared memory: they are copied first, so that no other process can change them any more.
  static void invoke(const void* arguments, void* result) {
    Args args{};
    if constexpr (!std::is_empty_v<Args>) {
      std::memcpy(static_cast<void*>(&args), arguments, sizeof(Args));
    }
    if constexpr (std::is_void_v<Result>) {
      Tag::apply(Code, args);
    } else {
      const Result value = Tag::apply(Code, args);
      std::memcpy(result, static_cast<const void*>(&value), sizeof(Result));
    }
  }

  FunctionOffer offer_;
};

}  // namespace detail
}  // namespace indurop

#define INDUROP_JOIN_(a, b) a##b  // NOLINT(readability-identifier-naming): the second step of the other
#define INDUROP_JOIN(a, b) INDUROP_JOIN_(a, b)

// Makes `code` (a function, or a captureless lambda) the implementation of the shared function `shared`: at namespace
// scope of one source file of the one module that implements it, with or without a semicolon. A thread of that module
// serves the calls one after the other, so an implementation that calls into a module which is itself waiting for this
// one ends in a time-out; it may freely call functions of its own module. A thrown exception reaches the caller as
// Errc::Failed.
#define INDUROP_IMPLEMENT(shared, ...)                                                                             \
  static const ::indurop::detail::Implementation<std::remove_cvref_t<decltype(shared)>, __VA_ARGS__> INDUROP_JOIN( \
      indurop_implementation_, __COUNTER__);
