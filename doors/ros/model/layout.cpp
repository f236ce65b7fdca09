// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/model/layout.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace indurop::ros {
namespace {

struct BaseWord {
  std::string_view word;
  Base base;
  std::size_t size;
};
constexpr std::array<BaseWord, 12> kBaseWords{{{"bool", Base::Bool, 1},
                                               {"char", Base::Char, 1},
                                               {"i8", Base::I8, 1},
                                               {"u8", Base::U8, 1},
                                               {"i16", Base::I16, 2},
                                               {"u16", Base::U16, 2},
                                               {"i32", Base::I32, 4},
                                               {"u32", Base::U32, 4},
                                               {"i64", Base::I64, 8},
                                               {"u64", Base::U64, 8},
                                               {"f32", Base::F32, 4},
                                               {"f64", Base::F64, 8}}};
constexpr std::size_t kEnumBytes = 4;

// Reads the text from its beginning; what was read is removed.
class LayoutReader {
 public:
  explicit LayoutReader(std::string_view text) : rest_(text) {}

  std::optional<Layout> type() {
    Layout layout;
    if (!base(layout)) {
      return std::nullopt;
    }
    while (take("[")) {
      const auto dim = number();
      if (!dim || *dim == 0 || !take("]")) {
        return std::nullopt;
      }
      layout.dims.push_back(*dim);
    }
    return layout;
  }
  [[nodiscard]] bool is_at_end() const noexcept { return rest_.empty(); }

 private:
  bool take(std::string_view what) {
    const bool found = rest_.starts_with(what);
    rest_.remove_prefix(found ? what.size() : 0);
    return found;
  }
  std::optional<std::size_t> number() {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) {
      return std::nullopt;
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  bool base(Layout& layout) {
    if (take("text(")) {
      layout.base = Base::Text;
      const auto size = number();
      layout.element = size.value_or(0);
      return size && take(")");
    }
    if (take("enum{")) {
      layout.base = Base::Enum;
      layout.element = kEnumBytes;
      const std::size_t end = rest_.find('}');
      rest_.remove_prefix(std::min(end, rest_.size()));
      return take("}");
    }
    if (take("struct(")) {
      return fields(layout);
    }
    const auto end = static_cast<std::size_t>(
        std::find_if_not(rest_.begin(), rest_.end(),
                         [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }) -
        rest_.begin());
    const auto* const known = std::find_if(kBaseWords.begin(), kBaseWords.end(),
                                           [&](const BaseWord& word) { return word.word == rest_.substr(0, end); });
    if (known == kBaseWords.end()) {
      return false;
    }
    rest_.remove_prefix(end);
    layout.base = known->base;
    layout.element = known->size;
    return true;
  }
  bool fields(Layout& layout) {
    layout.base = Base::Struct;
    const auto size = number();
    if (!size || !take(",") || !number() || !take("){")) {
      return false;
    }
    layout.element = *size;
    while (!take("}")) {
      Field field;
      const std::size_t at = rest_.find('@');
      field.name = std::string(rest_.substr(0, at));
      rest_.remove_prefix(std::min(at, rest_.size()));
      const auto offset = take("@") ? number() : std::nullopt;
      auto inner = offset && take(":") ? type() : std::nullopt;
      if (!inner || *offset + inner->size() > layout.element) {
        return false;
      }
      field.offset = *offset;
      field.type = std::move(*inner);
      layout.fields.push_back(std::move(field));
      take(",");
    }
    return true;
  }

  std::string_view rest_;
};

template <class T>
T load_as(std::span<const std::uint8_t> bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

// Calls `act` with a value of the C++ type of a number.
template <class Act>
void with_type(Base base, const Act& act) {
  switch (base) {
    case Base::Bool:
    case Base::Char:
    case Base::U8:
      return act(std::uint8_t{});
    case Base::I8:
      return act(std::int8_t{});
    case Base::I16:
      return act(std::int16_t{});
    case Base::U16:
      return act(std::uint16_t{});
    case Base::I32:
    case Base::Enum:
      return act(std::int32_t{});
    case Base::U32:
      return act(std::uint32_t{});
    case Base::I64:
      return act(std::int64_t{});
    case Base::U64:
      return act(std::uint64_t{});
    case Base::F32:
      return act(float{});
    case Base::F64:
      return act(double{});
    case Base::Text:
    case Base::Struct:
      return;
  }
}

template <class T>
T nearest_to(double number) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(number);
  } else {
    constexpr auto kLeast = static_cast<double>(std::numeric_limits<T>::min());
    constexpr auto kMost = static_cast<double>(std::numeric_limits<T>::max());
    if (!(number > kLeast)) {
      return std::numeric_limits<T>::min();
    }
    return number >= kMost ? std::numeric_limits<T>::max() : static_cast<T>(std::llround(number));
  }
}

}  // namespace

std::size_t Layout::count() const noexcept {
  std::size_t all = 1;
  for (const std::size_t dim : dims) {
    all *= dim;
  }
  return all;
}

std::optional<Layout> read_layout(std::string_view text) {
  LayoutReader reader(text);
  auto layout = reader.type();
  return layout && reader.is_at_end() ? layout : std::nullopt;
}

std::optional<Spot> find_spot(const Layout& layout, std::string_view part) {
  const Layout* type = &layout;
  std::size_t offset = 0;
  std::size_t passed = 0;  // dimensions that were chosen from
  while (!part.empty()) {
    if (part.front() == '[') {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(part.data() + 1, part.data() + part.size(), index);
      const auto length = static_cast<std::size_t>(end - part.data()) + 1;
      if (error != std::errc() || part.size() < length || *end != ']' || passed >= type->dims.size() ||
          index >= type->dims[passed]) {
        return std::nullopt;
      }
      std::size_t step = type->element;
      for (std::size_t i = ++passed; i < type->dims.size(); ++i) {
        step *= type->dims[i];
      }
      offset += index * step;
      part.remove_prefix(length);
      continue;
    }
    part.remove_prefix(part.front() == '.' ? 1 : 0);
    const std::string_view name = part.substr(0, part.find_first_of(".["));
    const auto field =
        std::find_if(type->fields.begin(), type->fields.end(), [name](const Field& one) { return one.name == name; });
    if (passed != type->dims.size() || field == type->fields.end()) {
      return std::nullopt;
    }
    offset += field->offset;
    type = &field->type;
    passed = 0;
    part.remove_prefix(name.size());
  }
  if (passed != type->dims.size() || type->base == Base::Text || type->base == Base::Struct) {
    return std::nullopt;
  }
  return Spot{type->base, offset};
}

double number_in(std::span<const std::uint8_t> bytes, Base base) {
  double number = 0;
  with_type(base, [&](auto zero) { number = static_cast<double>(load_as<decltype(zero)>(bytes)); });
  return number;
}

void put_number(std::span<std::uint8_t> bytes, Base base, double number) {
  with_type(base, [&](auto zero) {
    const auto value = nearest_to<decltype(zero)>(number);
    std::memcpy(bytes.data(), &value, sizeof(value));
  });
}

}  // namespace indurop::ros
