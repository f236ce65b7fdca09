// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

namespace indurop::recording {
namespace {

using base::Problem;
using Kind = IdlLeaf::Kind;

constexpr int kMaxDepth = 32;

struct Member {
  std::string type;  // "string" for all texts
  std::string name;
  std::vector<std::uint64_t> dims;
};
struct Definition {
  bool is_enum = false;
  std::vector<Member> members;
};

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

class IdlReader {
 public:
  explicit IdlReader(std::string_view text) : text_(text) {}

  bool read() {
    while (next()) {
      if (token_ == "module") {
        next();
        scopes_.push_back(token_);
        next();  // {
      } else if (token_ == "}") {
        if (scopes_.empty()) {
          return false;
        }
        scopes_.pop_back();
      } else if (token_ == "struct") {
        if (!structure()) {
          return false;
        }
      } else if (token_ == "enum") {
        if (!enumeration()) {
          return false;
        }
      } else if (token_ == "@") {
        next();  // its name
      } else if (token_ != ";") {
        return false;
      }
    }
    return scopes_.empty();
  }
  [[nodiscard]] const std::map<std::string, Definition>& definitions() const noexcept { return definitions_; }

 private:
  static bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  }

  // Reads the next token: a word with its "::", else one character.
  bool next() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t' || text_[at_] == '\r')) {
      ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_word(text_[at_]) || text_.substr(at_, 2) == "::")) {
      at_ += is_word(text_[at_]) ? 1U : 2U;
    }
    at_ += at_ == begin && at_ < text_.size() ? 1U : 0U;
    token_ = std::string(text_.substr(begin, at_ - begin));
    return !token_.empty();
  }

  std::string full_name() const {
    std::string out;
    for (const std::string& scope : scopes_) {
      out += scope + "::";
    }
    return out + token_;
  }
  static std::string plain(const std::string& name) { return name.starts_with('_') ? name.substr(1) : name; }

  std::optional<std::uint64_t> number() {
    next();
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(token_.data(), token_.data() + token_.size(), value);
    return code == std::errc() && end == token_.data() + token_.size() ? std::optional(value) : std::nullopt;
  }

  bool structure() {
    next();
    Definition& made = definitions_[full_name()];
    next();
    while (token_ == "{" && next()) {
      while (token_ != "}") {
        if (!member(made) || !next()) {
          return false;
        }
      }
      return true;
    }
    return false;
  }

  bool member(Definition& to) {
    Member one;
    one.type = token_;
    next();
    if (one.type == "string" && token_ == "<") {
      if (!number() || !next() || token_ != ">") {
        return false;
      }
      next();
    }
    one.name = plain(token_);
    next();
    while (token_ == "[") {
      const auto size = number();
      if (!size || !next() || token_ != "]") {
        return false;
      }
      one.dims.push_back(*size);
      next();
    }
    to.members.push_back(std::move(one));
    return token_ == ";";
  }

  bool enumeration() {
    next();
    definitions_[full_name()].is_enum = true;
    while (next()) {
      if (token_ == "}") {
        return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string token_;
  std::vector<std::string> scopes_;
  std::map<std::string, Definition> definitions_;
};

class Flattener {
 public:
  explicit Flattener(const std::map<std::string, Definition>& definitions) : definitions_(definitions) {}

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
    if (found == definitions_.end() || depth > kMaxDepth) {
      return false;
    }
    if (found->second.is_enum) {
      leaves.push_back({name, Kind::Enum});
      return leaves.size() <= kMaxLeaves;
    }
    const auto& members = found->second.members;
    // A struct that only wraps its member adds no name.
    const bool wraps = type.starts_with("indurop::value_") && members.size() == 1 && members[0].name == "value";
    return std::all_of(members.begin(), members.end(), [&](const Member& member) {
      return add_elements(member, 0, wraps ? name : name + "." + member.name, depth + 1);
    });
  }

  std::vector<IdlLeaf> leaves;

 private:
  bool add_elements(const Member& member, std::size_t dim, const std::string& name, int depth) {
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

  const std::map<std::string, Definition>& definitions_;
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
  IdlReader reader(text);
  if (!reader.read()) {
    return Problem{fmt::format("the definition of {} is not understood", name)};
  }
  Flattener flat(reader.definitions());
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
