// SPDX-License-Identifier: Apache-2.0
// What the C++ generated from PLC programs needs in addition to the standard library of IEC 61131-3: transfer of values
// between the program and the shared variables, and loops. Real-time safe.

#pragma once

#include <indurop/detail/variable_access.h>
#include <indurop/plc/clock.h>
#include <indurop/plc/log.h>
#include <indurop/plc/types.h>
#include <indurop/var.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

// A service of libindurop: the number changes each time shared variables were bound to addresses. Any thread; real-time
// safe.
extern "C" std::uint32_t indurop_bindings() noexcept;

namespace indurop::iec {

// Copies between the types of a PLC program and those of shared variables: numbers, BOOL and enumerations into each
// other, times as nanoseconds, arrays by element, structs with copy_fields() of the generated code.
template <class To, class From>
constexpr void copy_value(To& to, const From& from) {
  if constexpr (std::is_same_v<To, From>) {
    to = from;
  } else if constexpr (Timelike<To>) {
    to.ns = static_cast<std::int64_t>(from);
  } else if constexpr (Timelike<From>) {
    to = static_cast<To>(from.ns);
  } else if constexpr (Text<To> && Text<From>) {
    to = To(from.view());
  } else if constexpr (std::is_scalar_v<To>) {
    to = static_cast<To>(from);
  } else {
    copy_fields(to, from);
  }
}

template <class To, class From, std::size_t N>
constexpr void copy_value(std::array<To, N>& to, const std::array<From, N>& from) {
  if constexpr (std::is_same_v<To, From>) {
    to = from;
  } else {
    for (std::size_t i = 0; i < N; ++i) {
      copy_value(to[i], from[i]);
    }
  }
}

// A WSTRING is shared as an array of numbers.
template <std::size_t N>
constexpr void copy_value(WideText<N>& to, const std::array<std::uint16_t, N>& from) {
  std::copy(from.begin(), from.end() - 1, to.data);  // the last one remains the terminator
}
template <std::size_t N>
constexpr void copy_value(std::array<std::uint16_t, N>& to, const WideText<N>& from) {
  std::copy(from.data, from.data + N, to.begin());
}

namespace detail {

// A value that is not on the stack, for which a variable may be too large. One thread, one value of the type at a time.
template <class T>
T& staging() noexcept {
  static T value{};
  return value;
}

}  // namespace detail

// Copies the whole shared variable once and not via the stack.
template <class T, class Shared>
void read_image(T& to, const Shared& from) {
  using Whole = typename Shared::whole_type;
  using Tag = typename Shared::tag_type;
  if constexpr (Tag::kKind == abi::Kind::Scalar) {
    copy_value(to, from.get());
  } else {
    indurop::detail::record_access<Tag, indurop::detail::kRead>();
    const auto read = [](void* value) {
      abi::RingHeader* ring = indurop::detail::ring_of<Tag>();
      const std::uint64_t seq = ring->seq.load(std::memory_order_acquire);
      if (!indurop::detail::try_copy(ring, abi::slot_stride(Tag::kSize), seq, value, 0, sizeof(Whole))) [[unlikely]] {
        indurop::detail::ring_read_again<Tag::kSize>(ring, value, 0, sizeof(Whole));
      }
    };
    if constexpr (std::is_same_v<T, Whole>) {
      read(&to);
    } else {
      Whole& whole = detail::staging<Whole>();
      read(&whole);
      copy_value(to, whole);
    }
  }
}

// Writes a shared variable, or a part of it, if the program changed it: values that other writers wrote meanwhile stay.
template <class Shared, class T>
void write_changed(const Shared& to, const T& now, const T& before) {
  using Whole = typename Shared::whole_type;
  if (now == before) {
    return;
  }
  if constexpr (std::is_same_v<T, Whole>) {
    to = now;
  } else {
    Whole& value = detail::staging<Whole>();
    copy_value(value, now);
    to = value;
  }
}

namespace detail {

// The innermost element types of a program's array and of its shared one, whatever their dimensions.
template <class Own, class Shared>
struct Elements {
  using OwnType = Own;
  using SharedType = Shared;
  static constexpr std::size_t kCount = 1;
};
template <class Own, class Shared, std::size_t N>
struct Elements<std::array<Own, N>, std::array<Shared, N>> {
  using OwnType = typename Elements<Own, Shared>::OwnType;
  using SharedType = typename Elements<Own, Shared>::SharedType;
  static constexpr std::size_t kCount = N * Elements<Own, Shared>::kCount;
};

// Writes those of `count` elements from `offset` on that differ from their previous values, in one commit.
template <class Tag, class Own, class Shared>
void write_elements(std::uint32_t offset, const Own* now, const Own* before, std::size_t count) noexcept {
  indurop::detail::record_access<Tag, indurop::detail::kRead | indurop::detail::kWrite>();
  abi::RingHeader* ring = indurop::detail::ring_of<Tag>();
  auto* const to = static_cast<unsigned char*>(indurop_begin_write(ring, offset, count * sizeof(Shared)));
  if (to == nullptr) [[unlikely]] {
    return;
  }
  const std::uint64_t seq = ring->seq.load(std::memory_order_relaxed);
  const auto* const from = indurop::detail::slot(ring, seq, abi::slot_stride(Tag::kSize));
  Shared& value = staging<Shared>();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = offset + i * sizeof(Shared);
    if (now[i] == before[i]) {
      indurop::detail::copy_to_shared(to + at, from + at, sizeof(Shared));
    } else {
      copy_value(value, now[i]);
      indurop::detail::copy_to_shared(to + at, &value, sizeof(Shared));
    }
  }
  indurop_commit_write(ring);
}

}  // namespace detail

// Writes the elements of an array that the program changed: the rest may have other writers.
template <class Shared, class T, std::size_t N>
void write_changed(const Shared& to, const std::array<T, N>& now, const std::array<T, N>& before) {
  using All = detail::Elements<std::array<T, N>, typename Shared::whole_type>;
  using Own = typename All::OwnType;
  using Theirs = typename All::SharedType;
  static_assert(sizeof(typename Shared::whole_type) == All::kCount * sizeof(Theirs));
  if (now == before) {
    return;
  }
  const auto* const mine = reinterpret_cast<const Own*>(&now);
  const auto* const old = reinterpret_cast<const Own*>(&before);
  std::size_t first = 0;
  while (mine[first] == old[first]) {
    ++first;
  }
  std::size_t last = All::kCount - 1;
  while (mine[last] == old[last]) {
    --last;
  }
  const auto offset = static_cast<std::uint32_t>(first * sizeof(Theirs));
  detail::write_elements<typename Shared::tag_type, Own, Theirs>(Shared::kOffset + to.place.bytes + offset,
                                                                 mine + first, old + first, last - first + 1);
}

// A shared number as programs need it: with an indurop::Leaf for each of thousands, g++ would take longer than for the
// program.
template <class Tag, class T, std::uint32_t Offset>
struct SharedNumber {
  using whole_type = T;
  using tag_type = Tag;
  indurop::Place place;

  constexpr SharedNumber(indurop::Place at, indurop::detail::Make /*unused*/) noexcept : place(at) {}
  [[nodiscard]] T get() const noexcept { return indurop::detail::load<Tag, T>(Offset); }
  void operator=(T value) const noexcept { indurop::detail::store<Tag, T>(Offset, value); }  // NOLINT(*assign*)
};

// A number of the program that is shared.
struct SharedWord {
  const abi::Ref* shared;
  void* now;  // of the program
};

// Numbers of one size, of which the program writes the first `Written`. Those that are adjacent in the program are
// copied as one block. The addresses of the shared ones are cached: looking up 48 bytes for each of thousands takes
// longer than copying them. One thread; real-time safe.
template <class Bits, std::size_t N, std::size_t Written>
class SharedWords {
 public:
  constexpr explicit SharedWords(const std::array<SharedWord, N>& words) noexcept : words_(words) {}

  // Copies the shared values into the program, which uses them unchanged until the end of its scan.
  void read() noexcept {
    if (bindings_ != indurop_bindings()) {
      bind();
    }
    const void* const* entry = entries_.data();
    Bits* before = before_.data();
    for (std::size_t i = 0; i < stretches_; ++i) {
      Any* now = at_[i].now;
      const void* const* const end = entry + at_[i].count;
      if (i < written_stretches_) {
        for (; entry != end; ++entry) {
          const Bits value = __atomic_load_n(static_cast<const Bits*>(*entry), __ATOMIC_ACQUIRE);
          *now++ = value;
          *before++ = value;
        }
      } else {
        for (; entry != end; ++entry) {
          *now++ = __atomic_load_n(static_cast<const Bits*>(*entry), __ATOMIC_ACQUIRE);
        }
      }
    }
  }

  // Writes the values that the program changed: values that other writers wrote meanwhile stay.
  void write() noexcept {
    std::size_t first = 0;
    for (std::size_t i = 0; i < written_stretches_; ++i) {
      const Stretch& one = at_[i];
      if (std::memcmp(one.now, before_.data() + first, one.count * sizeof(Bits)) != 0) {
        for (std::size_t k = 0; k < one.count; ++k) {
          if (one.now[k] != before_[first + k]) {
            indurop::detail::scalar_write<Bits>(words_[first + k].shared->entry, one.now[k]);
          }
        }
      }
      first += one.count;
    }
  }

 private:
  using Any [[gnu::may_alias]] = Bits;  // a number of any type of this size
  struct Stretch {
    Any* now;
    std::size_t count;
  };

  void bind() noexcept {
    bindings_ = indurop_bindings();
    stretches_ = 0;
    written_stretches_ = 0;
    for (std::size_t i = 0; i < N; ++i) {
      entries_[i] = words_[i].shared->entry;
      Any* now = static_cast<Any*>(words_[i].now);
      if (i > 0 && i != Written && now == at_[stretches_ - 1].now + at_[stretches_ - 1].count) {
        ++at_[stretches_ - 1].count;
        continue;
      }
      at_[stretches_++] = {now, 1};
      written_stretches_ += i < Written ? 1U : 0U;
    }
  }

  const std::array<SharedWord, N>& words_;
  std::array<const void*, N> entries_{};
  std::array<Bits, std::max<std::size_t>(Written, 1)> before_{};  // values at the start of the scan
  std::array<Stretch, N> at_{};
  std::size_t stretches_ = 0;
  std::size_t written_stretches_ = 0;
  std::uint32_t bindings_ = 0;
};

// VAR_ACCESS: a shared variable that follows one of a program. Values that other writers write into a Writable one are
// copied to the program's variable at the start of the next scan; without Writable they are overwritten by the
// program's value.
template <class T, bool Writable>
class Access {
 public:
  template <class Shared>
  void read(const Shared& from, T& variable) {
    read_image(now_, from);
    if (known_ && !(now_ == seen_)) {
      seen_ = now_;
      variable = now_;
    }
  }
  template <class Shared>
  void write(const Shared& to, const T& variable) {
    if constexpr (!Writable) {
      read_image(now_, to);
    }
    const bool differs = Writable ? !known_ || !(variable == seen_) : !(variable == now_);
    if (differs) {
      using Whole = typename Shared::whole_type;
      Whole& value = detail::staging<Whole>();
      copy_value(value, variable);
      to = value;
    }
    seen_ = variable;
    known_ = true;
  }

 private:
  T now_{};  // value of the shared one
  T seen_{};
  bool known_ = false;
};

// A FOR loop whose end, step or variable is known only at run time. It ends where the variable would overflow or leave
// its subrange; the variable stays within it.
template <Integer T>
class Loop {
 public:
  constexpr Loop(T end, T step) noexcept : end_(end), step_(step) {}
  constexpr Loop(T end, T step, T low, T high) noexcept : end_(end), step_(step), low_(low), high_(high) {}

  [[nodiscard]] constexpr bool runs(T value) const noexcept {
    return !over_ && (step_ >= T{} ? value <= end_ : value >= end_);
  }
  constexpr void next(T& value) noexcept {
    T after{};
    over_ = __builtin_add_overflow(value, step_, &after);
    const bool whole = low_ == std::numeric_limits<T>::min() && high_ == std::numeric_limits<T>::max();
    over_ = over_ || after < low_ || after > high_;
    value = over_ && !whole ? value : after;
  }

 private:
  T end_;
  T step_;
  T low_ = std::numeric_limits<T>::min();
  T high_ = std::numeric_limits<T>::max();
  bool over_ = false;
};

// A UNION: the bytes shared by all its fields. The code that uses it is compiled without strict aliasing.
template <class... Fields>
struct Overlap {
  static constexpr std::size_t kBytes = std::max({sizeof(Fields)...});
  alignas(std::max({alignof(Fields)...})) std::array<unsigned char, kBytes> bytes{};
  friend bool operator==(const Overlap&, const Overlap&) = default;
};
template <class Field, class Union>
auto& overlaid(Union& value) noexcept {
  if constexpr (std::is_const_v<Union>) {
    return reinterpret_cast<const Field&>(value.bytes);
  } else {
    return reinterpret_cast<Field&>(value.bytes);
  }
}

// For an output that the caller does not use.
template <class T>
constexpr T& scratch(T&& value = T{}) noexcept {
  return value;
}

// Returns an array with all elements equal to `value`.
template <class Array>
constexpr Array filled(const typename Array::value_type& value) noexcept {
  Array out{};
  for (auto& one : out) {
    one = value;
  }
  return out;
}

}  // namespace indurop::iec
