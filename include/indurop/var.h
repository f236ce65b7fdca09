// SPDX-License-Identifier: Apache-2.0
// Shared variables used like global variables (chapter, Figures 4, 5, 7, 13). The generated header builds each
// variable from the shapes here: Leaf (number, bool, enum), Text (char array), ArrayRef, and one generated union
// per struct. A shape is an address, not a value: `auto v = joints[0]` keeps referring to the variable.

#pragma once

#include <indurop/detail/freshness.h>
#include <indurop/detail/variable_access.h>
#include <indurop/string.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <utility>

// The type of a shared variable: INDUROP_TYPEOF(joints)::value_type v = joints[0]; (Figures 4 and 5)
#define INDUROP_TYPEOF(variable) std::remove_cvref_t<decltype(variable)>

namespace indurop {

// Position within its variable that a shape points to: the bytes that array indices have added. Every shape begins with
// it, so all members of a generated union share one word.
struct Place {
  std::uint32_t bytes;
};

// Template argument of every generated union: makes namespace indurop associated, so lock(...) is found.
struct Adl {};

namespace detail {

struct Make {};  // marks the constructors that only indexing and generated code call

template <class T>
concept Shape = requires(const T& shape) {
  typename T::whole_type;
  typename T::tag_type;
  {shape.get()};
};

template <class T, class Whole>
concept ShapeOf = Shape<T> && std::is_same_v<typename T::whole_type, Whole>;

template <class T>
INDUROP_ALWAYS_INLINE decltype(auto) value_of(const T& argument) noexcept {
  if constexpr (Shape<T>) {
    return argument.get();
  } else {
    return static_cast<const T&>(argument);
  }
}

template <class Tag>
INDUROP_ALWAYS_INLINE abi::RingHeader* ring_of() noexcept {
  return static_cast<abi::RingHeader*>(Tag::ref().entry);
}

template <class Tag, class T>
INDUROP_ALWAYS_INLINE T load(std::uint32_t offset) noexcept {
  record_access<Tag, kRead>();
  if constexpr (Tag::kKind == abi::Kind::Scalar) {
    T value;
    __atomic_load(static_cast<T*>(Tag::ref().entry), &value, __ATOMIC_ACQUIRE);
    return value;
  } else {
    return ring_read<T, Tag::kSize>(ring_of<Tag>(), offset);
  }
}

template <class Tag, class T>
INDUROP_ALWAYS_INLINE void store(std::uint32_t offset, const T& value) noexcept {
  record_access<Tag, kWrite>();
  if constexpr (Tag::kKind == abi::Kind::Scalar) {
    scalar_write<T>(Tag::ref().entry, value);
  } else {
    ring_write(ring_of<Tag>(), offset, value);
  }
}

template <class Tag, class T, class Change>
INDUROP_ALWAYS_INLINE T modify(std::uint32_t offset, Change change) noexcept {
  record_access<Tag, kRead | kWrite>();
  if constexpr (Tag::kKind == abi::Kind::Scalar) {
    return scalar_modify<T>(Tag::ref().entry, change);
  } else {
    return ring_modify<T, Tag::kSize>(ring_of<Tag>(), offset, change);
  }
}

}  // namespace detail

// The freshness of the variable's value, always of the whole variable, even if the shape is a part. Real-time safe.
//   age():   time since the board that owns it last confirmed it, whether or not it changed; zero on that board, and
//            nanoseconds::max() before the first confirmation. Network latency is not included.
//   valid(): the owner is alive, and age() is at most the @maxage of the declaration. True on the owner's board.
#define INDUROP_FRESHNESS(Tag)                                   \
  [[nodiscard]] static std::chrono::nanoseconds age() noexcept { \
    return ::indurop::detail::age<Tag>();                        \
  }                                                              \
  [[nodiscard]] static bool valid() noexcept {                   \
    return ::indurop::detail::valid<Tag>();                      \
  }

// Assigning to a proxy writes the variable; the proxies have the interface of the standard library's containers.
// NOLINTBEGIN(cert-dcl21-cpp, cert-oop54-cpp, *assign*, readability-identifier-naming)

// A number, bool or enum. Reading and assigning are one atomic access each; +=, ++ and similar operators are one atomic
// read-modify-write, `x = x + 1` is two accesses as in C. Real-time safe, any thread, any process.
template <class Tag, class T, std::uint32_t Offset>
struct Leaf {
  using value_type = T;
  using whole_type = T;
  using tag_type = Tag;
  static constexpr std::uint32_t kOffset = Offset;
  Place place;

  constexpr Leaf(Place at, detail::Make /*unused*/) noexcept : place(at) {}
  Leaf(const Leaf&) = default;
  ~Leaf() = default;

  INDUROP_ALWAYS_INLINE T get() const noexcept { return detail::load<Tag, T>(Offset + place.bytes); }
  INDUROP_ALWAYS_INLINE operator T() const noexcept { return get(); }  // NOLINT(google-explicit-constructor)

  INDUROP_FRESHNESS(Tag)

  INDUROP_ALWAYS_INLINE T operator=(T value) const noexcept {
    detail::store<Tag, T>(Offset + place.bytes, value);
    return value;
  }
  INDUROP_ALWAYS_INLINE T operator=(const Leaf& other) const noexcept { return *this = other.get(); }

  // Atomic read-modify-write by any function of the old value; `change` may be called more than once for a scalar.
  template <class Change>
  INDUROP_ALWAYS_INLINE T modify(Change change) const noexcept {
    return detail::modify<Tag, T>(Offset + place.bytes, change);
  }

#define INDUROP_COMPOUND(op)                                                                                  \
  template <class U>                                                                                          \
  INDUROP_ALWAYS_INLINE T operator op##=(const U& operand) const noexcept {                                   \
    const auto by = detail::value_of(operand);                                                                \
    return modify(                                                                                            \
        [by](T old) { return static_cast<T>(old op static_cast<std::common_type_t<T, decltype(by)>>(by)); }); \
  }
  INDUROP_COMPOUND(+)
  INDUROP_COMPOUND(-)
  INDUROP_COMPOUND(*)
  INDUROP_COMPOUND(/)
  INDUROP_COMPOUND(%)
  INDUROP_COMPOUND(&)
  INDUROP_COMPOUND(|)
  INDUROP_COMPOUND(^)
  INDUROP_COMPOUND(<<)
  INDUROP_COMPOUND(>>)
#undef INDUROP_COMPOUND

  INDUROP_ALWAYS_INLINE T operator++() const noexcept {
    return *this += 1;
  }
  INDUROP_ALWAYS_INLINE T operator--() const noexcept {
    return *this -= 1;
  }
  INDUROP_ALWAYS_INLINE T operator++(int) const noexcept {
    return static_cast<T>((*this += 1) - 1);
  }
  INDUROP_ALWAYS_INLINE T operator--(int) const noexcept {
    return static_cast<T>((*this -= 1) + 1);
  }
};

// A char array: text of at most N - 1 characters, read and assigned as a whole in one access.
template <class Tag, std::size_t N, std::uint32_t Offset>
struct Text {
  using value_type = string<N>;
  using whole_type = string<N>;
  using tag_type = Tag;
  static constexpr std::uint32_t kOffset = Offset;
  Place place;

  constexpr Text(Place at, detail::Make /*unused*/) noexcept : place(at) {}
  Text(const Text&) = default;
  ~Text() = default;

  INDUROP_ALWAYS_INLINE string<N> get() const noexcept { return detail::load<Tag, string<N>>(Offset + place.bytes); }
  operator string<N>() const noexcept { return get(); }  // NOLINT(google-explicit-constructor)
  const Text& operator=(std::string_view text) const noexcept {
    detail::store<Tag, string<N>>(Offset + place.bytes, string<N>(text));
    return *this;
  }
  const Text& operator=(const char* text) const noexcept { return *this = std::string_view(text); }
  const Text& operator=(const string<N>& text) const noexcept { return *this = text.view(); }
  const Text& operator=(const Text& other) const noexcept { return *this = other.get(); }

  INDUROP_FRESHNESS(Tag)
  [[nodiscard]] static constexpr std::size_t size() noexcept { return N; }
  INDUROP_ALWAYS_INLINE Leaf<Tag, char, Offset> operator[](std::size_t index) const {
    if (index >= N) [[unlikely]] {
      indurop_index_fault(Tag::ref().name, index, N);
    }
    return {Place{place.bytes + static_cast<std::uint32_t>(index)}, detail::Make{}};
  }

  bool operator==(std::string_view other) const noexcept { return get().view() == other; }
  bool operator==(const char* other) const noexcept { return get().view() == other; }
  bool operator==(const string<N>& other) const noexcept { return get() == other; }
  template <detail::ShapeOf<whole_type> Other>
  bool operator==(const Other& other) const noexcept {
    return get() == other.get();
  }
};

template <class Stream, class Tag, std::size_t N, std::uint32_t Offset>
auto operator<<(Stream& out, const Text<Tag, N, Offset>& text) -> decltype(out << std::string_view{}) {
  return out << text.get().view();
}

// N elements of the same type. Elements are shapes (one access each); get(), assignment and comparison take the whole
// array in one access. An index beyond the end throws std::out_of_range, which the scheduler reports as a module fault.
template <class Element, std::size_t N>
struct ArrayRef {
  using value_type = typename Element::whole_type;
  using whole_type = std::array<value_type, N>;
  using tag_type = typename Element::tag_type;
  using Tag = tag_type;
  static constexpr std::uint32_t kOffset = Element::kOffset;
  Place place;

  constexpr ArrayRef(Place at, detail::Make /*unused*/) noexcept : place(at) {}
  ArrayRef(const ArrayRef&) = default;
  ~ArrayRef() = default;

  INDUROP_ALWAYS_INLINE Element operator[](std::size_t index) const {
    if (index >= N) [[unlikely]] {
      indurop_index_fault(Tag::ref().name, index, N);
    }
    return {Place{place.bytes + static_cast<std::uint32_t>(index * sizeof(value_type))}, detail::Make{}};
  }
  INDUROP_FRESHNESS(Tag)
  [[nodiscard]] static constexpr std::size_t size() noexcept { return N; }

  INDUROP_ALWAYS_INLINE whole_type get() const noexcept { return detail::load<Tag, whole_type>(kOffset + place.bytes); }
  INDUROP_ALWAYS_INLINE operator whole_type() const noexcept { return get(); }  // NOLINT(google-explicit-constructor)
  INDUROP_ALWAYS_INLINE const ArrayRef& operator=(const whole_type& value) const noexcept {
    detail::store<Tag, whole_type>(kOffset + place.bytes, value);
    return *this;
  }
  const ArrayRef& operator=(const ArrayRef& other) const noexcept { return *this = other.get(); }

  class iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Element;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Element;
    iterator(ArrayRef array, std::size_t index) noexcept : array_(array), index_(index) {}
    iterator(const iterator&) = default;
    iterator& operator=(const iterator& other) noexcept {
      index_ = other.index_;
      return *this;
    }
    ~iterator() = default;
    Element operator*() const { return array_[index_]; }
    iterator& operator++() noexcept {
      ++index_;
      return *this;
    }
    iterator operator++(int) noexcept {
      iterator before = *this;
      ++index_;
      return before;
    }
    friend bool operator==(const iterator& a, const iterator& b) noexcept { return a.index_ == b.index_; }

   private:
    ArrayRef array_;
    std::size_t index_;
  };
  [[nodiscard]] iterator begin() const noexcept { return {*this, 0}; }
  [[nodiscard]] iterator end() const noexcept { return {*this, N}; }

  // Members, not friends: thousands of variables must not become one overload set.
  bool operator==(const whole_type& other) const noexcept { return get() == other; }
  template <detail::ShapeOf<whole_type> Other>
  bool operator==(const Other& other) const noexcept {
    return get() == other.get();
  }
};
// NOLINTEND(cert-dcl21-cpp, cert-oop54-cpp, *assign*, readability-identifier-naming)

// The members that every generated struct shape has in addition to its fields; it names its Place `indurop_place`, so
// that a field may have any name. A whole struct is read, assigned and compared in one access.
#define INDUROP_UNION_SHAPE(Self)                                                                 \
  constexpr Self(::indurop::Place indurop_at, ::indurop::detail::Make /*unused*/) noexcept        \
      : indurop_place(indurop_at) {}                                                              \
  Self(const Self&) = default;                                                                    \
  ~Self() = default;                                                                              \
  INDUROP_ALWAYS_INLINE whole_type get() const noexcept {                                         \
    return ::indurop::detail::load<tag_type, whole_type>(kOffset + indurop_place.bytes);          \
  }                                                                                               \
  INDUROP_ALWAYS_INLINE operator whole_type() const noexcept {                                    \
    return get();                                                                                 \
  }                                                                                               \
  INDUROP_ALWAYS_INLINE const Self& operator=(const whole_type& indurop_value) const noexcept {   \
    ::indurop::detail::store<tag_type, whole_type>(kOffset + indurop_place.bytes, indurop_value); \
    return *this;                                                                                 \
  }                                                                                               \
  INDUROP_ALWAYS_INLINE const Self& operator=(const Self& indurop_value) const noexcept {         \
    return *this = indurop_value.get();                                                           \
  }                                                                                               \
  bool operator==(const whole_type& indurop_other) const noexcept {                               \
    return get() == indurop_other;                                                                \
  }                                                                                               \
  template <::indurop::detail::ShapeOf<whole_type> indurop_shape>                                 \
  bool operator==(const indurop_shape& indurop_other) const noexcept {                            \
    return get() == indurop_other.get();                                                          \
  }

// age() and valid() as free functions for any shape: also usable for structs with fields of these names.
template <detail::Shape T>
[[nodiscard]] std::chrono::nanoseconds age(const T& /*shape*/) noexcept {
  return detail::age<typename T::tag_type>();
}
template <detail::Shape T>
[[nodiscard]] bool valid(const T& /*shape*/) noexcept {
  return detail::valid<typename T::tag_type>();
}

}  // namespace indurop
