// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "history/recording/idl_reader.h"

namespace indurop::recording {
namespace {

using base::Problem;
using Kind = IdlLeaf::Kind;

std::optional<Kind> kind_of(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, Kind>, 13> kKinds{{{"boolean", Kind::Bool},
                                                                      {"char", Kind::Char},
                                                                      {"int8", Kind::I8},
                                                                      {"uint8", Kind::U8},
                                                                      {"int16", Kind::I16},
                                                                      {"uint16", Kind::U16},
                                                                      {"int32", Kind::I32},
                                                                      {"uint32", Kind::U32},
                                                                      {"int64", Kind::I64},
                                                                      {"uint64", Kind::U64},
                                                                      {"float", Kind::F32},
                                                                      {"double", Kind::F64},
                                                                      {"string", Kind::Text}}};
  for (const auto& [name, kind] : kKinds) {
    if (name == type) {
      return kind;
    }
  }
  return std::nullopt;
}

class Flattener {
 public:
  explicit Flattener(const IdlDefinitions& definitions) : definitions_(definitions) {}

  bool add(const std::string& type, const std::string& name, int depth) {
    // Structs without members add no leaves, so the steps are limited too.
    if (++steps_ > kMaxSteps) {
      return false;
    }
    if (const auto kind = kind_of(type)) {
      leaves.push_back({name, *kind});
      return leaves.size() <= kMaxLeaves;
    }
    const auto found = definitions_.find(type);
    if (found == definitions_.end() || depth > kMaxIdlDepth) {
      return false;
    }
    if (found->second.is_enum) {
      leaves.push_back({name, Kind::Enum});
      return leaves.size() <= kMaxLeaves;
    }
    const auto& members = found->second.members;
    const bool wraps = is_wrapper(type, found->second);  // it adds no name
    return std::all_of(members.begin(), members.end(), [&](const IdlMember& member) {
      return add_elements(member, 0, wraps ? name : name + "." + member.name, depth + 1);
    });
  }

  std::vector<IdlLeaf> leaves;

 private:
  bool add_elements(const IdlMember& member, std::size_t dim, const std::string& name, int depth) {
    if (dim == member.dims.size()) {
      return add(member.type, name, depth);
    }
    for (std::uint64_t i = 0; i < member.dims[dim]; ++i) {
      if (!add_elements(member, dim + 1, fmt::format("{}[{}]", name, i), depth)) {
        return false;
      }
    }
    return true;
  }

  static constexpr std::size_t kMaxSteps = 4 * kMaxLeaves;

  const IdlDefinitions& definitions_;
  std::size_t steps_ = 0;
};

// Reads values from the front of a CDR message and passes them to `use` with their type.
class CdrCursor {
 public:
  explicit CdrCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  bool take(const auto& use) {
    T value{};
    if (!raw(value)) {
      return false;
    }
    use(value);
    return true;
  }
  bool take_text(const auto& use) {
    std::uint32_t length = 0;
    if (!raw(length) || length > bytes_.size() - at_) {
      return false;
    }
    const auto* const begin = reinterpret_cast<const char*>(bytes_.data() + at_);
    at_ += length;
    use(std::string_view(begin, length == 0 ? 0 : length - 1));  // without its NUL
    return true;
  }

 private:
  template <class T>
  bool raw(T& value) {
    at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    if (at_ > bytes_.size() || sizeof(T) > bytes_.size() - at_) {
      return false;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return true;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

bool take(CdrCursor& cursor, Kind kind, const auto& use) {
  switch (kind) {
    case Kind::Bool:
      return cursor.take<std::uint8_t>([&use](std::uint8_t value) { use(value != 0); });
    case Kind::Char:
    case Kind::U8:
      return cursor.take<std::uint8_t>(use);
    case Kind::I8:
      return cursor.take<std::int8_t>(use);
    case Kind::I16:
      return cursor.take<std::int16_t>(use);
    case Kind::U16:
      return cursor.take<std::uint16_t>(use);
    case Kind::I32:
    case Kind::Enum:
      return cursor.take<std::int32_t>(use);
    case Kind::U32:
      return cursor.take<std::uint32_t>(use);
    case Kind::I64:
      return cursor.take<std::int64_t>(use);
    case Kind::U64:
      return cursor.take<std::uint64_t>(use);
    case Kind::F32:
      return cursor.take<float>(use);
    case Kind::F64:
      return cursor.take<double>(use);
    case Kind::Text:
      return cursor.take_text(use);
  }
  return false;
}

// Calls use(i, value) for each leaf.
bool for_each_leaf(const std::vector<IdlLeaf>& layout, std::span<const std::uint8_t> cdr, const auto& use) {
  constexpr std::size_t kHead = 4;
  constexpr std::uint8_t kLittleEndian = 1;
  if (cdr.size() < kHead || cdr[0] != 0 || cdr[1] != kLittleEndian) {
    return false;
  }
  CdrCursor cursor(cdr.subspan(kHead));
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (!take(cursor, layout[i].kind, [&](const auto& value) { use(i, value); })) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<std::vector<IdlLeaf>, Problem> idl_layout(std::string_view text, std::string_view name) {
  const auto definitions = read_idl(text);
  if (!definitions) {
    return Problem{fmt::format("the definition of {} is not understood", name)};
  }
  Flattener flat(*definitions);
  if (!flat.add(std::string(name), "", 0)) {
    return Problem{fmt::format("{} is too large, or not defined", name)};
  }
  return std::move(flat.leaves);
}

bool read_leaves(const std::vector<IdlLeaf>& layout, std::span<const std::uint8_t> cdr, std::vector<double>& values) {
  values.resize(layout.size());
  return for_each_leaf(layout, cdr, [&values](std::size_t i, const auto& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      values[i] = static_cast<double>(value);
    } else {
      values[i] = std::nan("");
    }
  });
}

bool read_leaf_texts(const std::vector<IdlLeaf>& layout, std::span<const std::uint8_t> cdr,
                     std::vector<std::string>& values) {
  values.resize(layout.size());
  return for_each_leaf(layout, cdr, [&values](std::size_t i, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, bool>) {
      values[i] = value ? "true" : "false";
    } else {
      values[i] = fmt::format("{}", value);
    }
  });
}

}  // namespace indurop::recording
