// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/text.h"

#include <algorithm>
#include <charconv>

namespace indurop::robot {

namespace {

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
char small(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}

// Length of an index that is a number, "[12]"; 0: it is computed, or there is none.
std::size_t index_length(std::string_view text) noexcept {
  std::size_t n = 1;
  while (n < text.size() && is_digit(text[n])) {
    ++n;
  }
  return n > 1 && n < text.size() && text[0] == '[' && text[n] == ']' ? n + 1 : 0;
}

// Length of a word; names of variables contain dots, colons and indices.
std::size_t word_length(std::string_view text) noexcept {
  std::size_t n = 0;
  while (n < text.size()) {
    const std::string_view rest = text.substr(n);
    std::size_t more = is_letter(rest[0]) || is_digit(rest[0]) || rest[0] == '.' ? 1 : index_length(rest);
    more = rest.starts_with("::") ? 2 : more;
    if (more == 0) {
      break;
    }
    n += more;
  }
  return n;
}

std::size_t number_length(std::string_view text, double& value) noexcept {
  // from_chars also accepts "inf" and "nan", and no plus sign.
  const bool plus = text.front() == '+';
  const std::string_view digits = text.substr(plus ? 1 : 0);
  const std::string_view unsigned_part = digits.substr(!plus && digits.starts_with('-') ? 1 : 0);
  if (unsigned_part.empty() || !(is_digit(unsigned_part.front()) || unsigned_part.front() == '.')) {
    return 0;
  }
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc{} ? static_cast<std::size_t>(end - text.data()) : 0;
}

JobToken next_token(std::string_view text) noexcept {
  JobToken token;
  if (is_letter(text.front())) {
    token.kind = JobToken::Kind::Word;
    token.text = text.substr(0, word_length(text));
  } else if (const std::size_t n = number_length(text, token.value); n > 0) {
    token.kind = JobToken::Kind::Number;
    token.text = text.substr(0, n);
  } else if (std::string_view("=<>!%,/+-*()[]:").find(text.front()) != std::string_view::npos) {
    const bool two =
        text.size() > 1 && text[1] == '=' && std::string_view("=<>!").find(text[0]) != std::string_view::npos;
    const bool unequal = text.starts_with("<>");
    token.kind = JobToken::Kind::Sign;
    token.text = text.substr(0, two || unequal ? 2 : 1);
  } else if (const std::size_t end = text.find('"', 1); text.front() == '"' && end != std::string_view::npos) {
    token.kind = JobToken::Kind::Text;
    token.text = text.substr(0, end + 1);
  } else {
    token.kind = JobToken::Kind::Junk;
    token.text = text.substr(0, 1);
  }
  return token;
}

}  // namespace

JobLines::JobLines(std::string_view text) noexcept : rest_(text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  rest_.remove_prefix(rest_.starts_with(kMark) ? kMark.size() : 0);
}

std::string_view JobLines::take() noexcept {
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return line;
}

std::vector<JobToken> split_job_line(std::string_view line) {
  std::vector<JobToken> tokens;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && (line[at] == ' ' || line[at] == '\t' || line[at] == '\r')) {
      ++at;
    }
    const std::string_view rest = line.substr(std::min(at, line.size()));
    if (rest.empty() || rest.front() == '#' || rest.starts_with("//")) {
      JobToken end;
      end.column = at + 1;
      tokens.push_back(end);
      return tokens;
    }
    JobToken token = next_token(rest);
    token.column = at + 1;
    at += token.text.size();
    tokens.push_back(token);
  }
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return small(x) == small(y); });
}

std::string in_quotes(std::string_view text) {
  return "'" + std::string(text) + "'";
}

}  // namespace indurop::robot
