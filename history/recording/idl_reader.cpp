// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_reader.h"

#include <charconv>
#include <utility>

namespace indurop::recording {
namespace {

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
  IdlDefinitions take() && { return std::move(definitions_); }

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

  template <class Number>
  std::optional<Number> number() {
    next();
    Number value = 0;
    const auto [end, code] = std::from_chars(token_.data(), token_.data() + token_.size(), value);
    return code == std::errc() && end == token_.data() + token_.size() ? std::optional(value) : std::nullopt;
  }

  bool structure() {
    next();
    IdlDefinition& made = definitions_[full_name()];
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

  bool member(IdlDefinition& to) {
    IdlMember one;
    one.type = token_;
    next();
    if (one.type == "string" && token_ == "<") {
      const auto bound = number<std::uint64_t>();
      if (!bound || !next() || token_ != ">") {
        return false;
      }
      one.bound = *bound;
      next();
    }
    one.name = plain(token_);
    next();
    while (token_ == "[") {
      const auto size = number<std::uint64_t>();
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
    IdlDefinition& made = definitions_[full_name()];
    made.is_enum = true;
    if (!next() || token_ != "{") {
      return false;
    }
    for (std::int64_t value = 0; next();) {
      if (token_ == "}") {
        return true;
      }
      if (token_ == "@" && !explicit_value(value)) {
        return false;
      }
      if (token_ != ",") {
        made.enumerators.push_back({plain(token_), value++});
      }
    }
    return false;
  }

  // Reads the rest of "@value(-3)" and the name after it.
  bool explicit_value(std::int64_t& value) {
    if (!next() || token_ != "value" || !next() || token_ != "(") {
      return false;
    }
    const bool negative = text_.substr(at_, 1) == "-";
    at_ += negative ? 1U : 0U;
    const auto found = number<std::int32_t>();
    value = negative ? -std::int64_t{found.value_or(0)} : found.value_or(0);
    return found && next() && token_ == ")" && next();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string token_;
  std::vector<std::string> scopes_;
  IdlDefinitions definitions_;
};

}  // namespace

std::optional<IdlDefinitions> read_idl(std::string_view text) {
  IdlReader reader(text);
  return reader.read() ? std::optional(std::move(reader).take()) : std::nullopt;
}

bool is_wrapper(const std::string& name, const IdlDefinition& definition) {
  return name.starts_with("indurop::value_") && definition.members.size() == 1 && definition.members[0].name == "value";
}

}  // namespace indurop::recording
