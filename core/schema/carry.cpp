// SPDX-License-Identifier: Apache-2.0
#include "core/schema/carry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/schema/leaf.h"

namespace indurop::schema {
namespace {

__extension__ using Whole = __int128;
using Bytes = std::span<const std::uint8_t>;
using Room = std::span<std::uint8_t>;

constexpr std::size_t kMaxLines = 8;

bool is_real(Base base) noexcept {
  return base == Base::Float || base == Base::Double;
}

bool is_number(Base base) noexcept {
  return base != Base::Text && base != Base::Enum && base != Base::Struct;
}

// Returns true and stores the number if it fits.
template <class T>
bool put(Whole value, Room to) noexcept {
  if (value < Whole{std::numeric_limits<T>::min()} || value > Whole{std::numeric_limits<T>::max()}) {
    return false;
  }
  const T stored = static_cast<T>(value);
  std::memcpy(to.data(), &stored, sizeof stored);
  return true;
}

bool put_whole(Base base, Whole value, Room to) noexcept {
  switch (base) {
    case Base::Bool:
      return (value == 0 || value == 1) && put<std::uint8_t>(value, to);
    case Base::Char:
    case Base::UInt8:
      return put<std::uint8_t>(value, to);
    case Base::Int8:
      return put<std::int8_t>(value, to);
    case Base::Int16:
      return put<std::int16_t>(value, to);
    case Base::UInt16:
      return put<std::uint16_t>(value, to);
    case Base::Int32:
      return put<std::int32_t>(value, to);
    case Base::UInt32:
      return put<std::uint32_t>(value, to);
    case Base::Int64:
      return put<std::int64_t>(value, to);
    default:
      return put<std::uint64_t>(value, to);
  }
}

// Stores the nearest number; a finite number that would become infinite or NaN does not fit.
template <class T, class From>
bool put_nearest(From value, Room to) noexcept {
  const T stored = static_cast<T>(value);
  if (!std::isfinite(stored) && std::isfinite(static_cast<double>(value))) {
    return false;
  }
  std::memcpy(to.data(), &stored, sizeof stored);
  return true;
}

template <class From>
bool put_real(Base base, From value, Room to) noexcept {
  return base == Base::Float ? put_nearest<float>(value, to) : put_nearest<double>(value, to);
}

// Returns true if the fields of two equal types also have the same units.
bool same_units(const Type& a, const Type& b) {
  return std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), [](const Field& one, const Field& other) {
    return one.unit == other.unit && same_units(one.type, other.type);
  });
}

class Carrier {
 public:
  enum class Lines { All, OfValues };
  explicit Carrier(Lines lines) noexcept : wanted_(lines) {}

  void value(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    if (canonical(from) == canonical(to) && same_units(from, to)) {
      std::copy(old.begin(), old.end(), now.begin());
    } else if (from.dims.size() != to.dims.size()) {
      declared(name, fmt::format("was {}, is {}", display_name(from), display_name(to)));
    } else if (!from.dims.empty()) {
      array(name, from, old, to, now);
    } else {
      element(name, from, old, to, now);
    }
  }

  // What follows from the declarations.
  void declared(const std::string& name, const std::string& why) {
    if (wanted_ == Lines::All) {
      lost(name, why);
    }
  }
  void lost(const std::string& name, const std::string& why) {
    line(fmt::format("{}: {}, starts with its initial value", name, why));
  }
  void line(std::string text) {
    ++count_;
    if (lines_.size() < kMaxLines) {
      lines_.push_back(std::move(text));
    }
  }

  std::vector<std::string> take(const std::string& name) {
    if (count_ > lines_.size()) {
      lines_.push_back(fmt::format("{}: and {} more", name, count_ - lines_.size()));
    }
    return std::move(lines_);
  }

 private:
  static Type row_of(const Type& array) {
    Type row = array;
    row.dims.erase(row.dims.begin());
    return row;
  }

  void array(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    const std::uint32_t before = from.dims.front();
    const std::uint32_t after = to.dims.front();
    if (before != after && wanted_ == Lines::All) {
      line(fmt::format("{}: had {} elements, has {}; {} are kept from the first on", name, before, after,
                       std::min(before, after)));
    }
    const Type old_row = row_of(from);
    const Type new_row = row_of(to);
    for (std::size_t i = 0; i < std::min(before, after); ++i) {
      value(fmt::format("{}[{}]", name, i), old_row, old.subspan(i * old_row.size(), old_row.size()), new_row,
            now.subspan(i * new_row.size(), new_row.size()));
    }
  }

  void element(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    if (is_number(from.base) && is_number(to.base)) {
      number(name, from, old, to, now);
    } else if (from.base != to.base) {
      declared(name, fmt::format("was {}, is {}", display_name(from), display_name(to)));
    } else if (from.base == Base::Text) {
      text(name, old, now);
    } else if (from.base == Base::Enum) {
      enumerator(name, from, old, to, now);
    } else {
      fields(name, from, old, to, now);
    }
  }

  void number(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    bool fits = false;
    if (is_real(from.base)) {
      const double value = from.base == Base::Float ? double{load<float>(old.data())} : load<double>(old.data());
      constexpr double kIntegerLimit = 1e30;  // beyond all integers
      const bool whole = std::abs(value) < kIntegerLimit && std::trunc(value) == value;
      fits = is_real(to.base) ? put_real(to.base, value, now)
                              : whole && put_whole(to.base, static_cast<Whole>(value), now);
    } else {
      const Whole value = *as_number<Whole>(from.base, old.data());
      fits = is_real(to.base) ? put_real(to.base, value, now) : put_whole(to.base, value, now);
      if (fits && is_real(to.base)) {
        const double kept = to.base == Base::Float ? double{load<float>(now.data())} : load<double>(now.data());
        if (static_cast<Whole>(kept) != value) {
          line(fmt::format("{}: was {}, is {} rounded to {}", name, format_value(from, old), format_value(to, now),
                           display_name(to)));
        }
      }
    }
    if (!fits) {
      lost(name, fmt::format("{} is no value of {}", format_value(from, old), display_name(to)));
    }
  }

  void text(const std::string& name, Bytes old, Room now) {
    const auto end = std::find(old.begin(), old.end(), std::uint8_t{0});
    const auto length = static_cast<std::size_t>(end - old.begin());
    const std::size_t kept = std::min(length, now.size() - 1);
    std::fill(std::copy_n(old.begin(), kept, now.begin()), now.end(), std::uint8_t{0});
    if (kept < length) {
      line(fmt::format("{}: had {} characters, {} are kept", name, length, kept));
    }
  }

  void enumerator(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    const auto number = load<std::int32_t>(old.data());
    const auto was = std::find_if(from.enumerators.begin(), from.enumerators.end(),
                                  [&](const Enumerator& one) { return one.value == number; });
    const auto is = std::find_if(to.enumerators.begin(), to.enumerators.end(), [&](const Enumerator& one) {
      return was != from.enumerators.end() && one.name == was->name;
    });
    if (is == to.enumerators.end() || !put<std::int32_t>(is->value, now)) {
      lost(name, fmt::format("{} is no value of {}", format_value(from, old), display_name(to)));
    }
  }

  void fields(const std::string& name, const Type& from, Bytes old, const Type& to, Room now) {
    for (const Field& was : from.fields) {
      const std::string inner = name + "." + was.name;
      const auto is =
          std::find_if(to.fields.begin(), to.fields.end(), [&](const Field& one) { return one.name == was.name; });
      if (is == to.fields.end()) {
        if (wanted_ == Lines::All) {
          line(inner + ": is no longer declared");
        }
      } else if (was.unit != is->unit) {
        unit(inner, was.unit, is->unit);
      } else {
        value(inner, was.type, old.subspan(was.offset, was.type.size()), is->type,
              now.subspan(is->offset, is->type.size()));
      }
    }
  }

 public:
  void unit(const std::string& name, const std::string& was, const std::string& is) {
    declared(name, fmt::format("its unit was '{}', is '{}'", was, is));
  }

 private:
  Lines wanted_;
  std::vector<std::string> lines_;
  std::size_t count_ = 0;
};

std::vector<std::string> carried_by(Carrier carrier, const std::string& name, const Kept& from, Bytes old,
                                    const Kept& to, Room now) {
  if (old.size() != from.type.size() || now.size() != to.type.size()) {
    carrier.lost(name, "its kept value is damaged");
  } else if (from.unit != to.unit) {
    carrier.unit(name, from.unit, to.unit);
  } else {
    carrier.value(name, from.type, old, to.type, now);
  }
  return carrier.take(name);
}

}  // namespace

std::vector<std::string> carry_value(const std::string& name, const Kept& from, Bytes old, const Kept& to, Room now) {
  return carried_by(Carrier(Carrier::Lines::All), name, from, old, to, now);
}

std::vector<std::string> carry_what_fits(const std::string& name, const Kept& from, Bytes old, const Kept& to,
                                         Room now) {
  return carried_by(Carrier(Carrier::Lines::OfValues), name, from, old, to, now);
}

}  // namespace indurop::schema
