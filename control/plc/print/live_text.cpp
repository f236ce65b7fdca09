// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/live_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/model/identifier.h"
#include "control/plc/st/lexer.h"

namespace indurop::plc {
namespace {

using st::Token;
using st::TokenKind;

// A name in the text, and the members and indices after it.
struct Mention {
  std::string written;
  int line = 0;
};

bool is_name(const Token& token) {
  return token.kind == TokenKind::Word && is_identifier(token.text) && !is_keyword(token.text);
}

// Consumes "[3" or "[1, -2" and so on: elements whose indices are in the text.
std::size_t take_index(const std::vector<Token>& tokens, std::size_t at, std::string& path) {
  std::string text = "[";
  std::size_t next = at + 1;
  const auto minus = [&](std::size_t i) {
    return tokens[i].is("-") && (tokens[i - 1].is("[") || tokens[i - 1].is(","));
  };
  while (next < tokens.size() && (tokens[next].kind == TokenKind::Number || tokens[next].is(",") || minus(next))) {
    text += tokens[next++].text;
  }
  if (next == at + 1 || next >= tokens.size() || !tokens[next].is("]")) {
    return at;
  }
  path += text + "]";
  return next + 1;
}

std::vector<Mention> mentions_in(std::string_view text) {
  Diagnostics quiet;
  const std::vector<Token> tokens = st::tokenize(text, {}, quiet);
  std::vector<Mention> found;
  for (std::size_t i = 0; i < tokens.size();) {
    if (!is_name(tokens[i])) {
      ++i;
      continue;
    }
    Mention one{std::string(tokens[i].text), tokens[i].line};
    for (++i; i < tokens.size();) {
      if (tokens[i].is(".") && i + 1 < tokens.size() && is_name(tokens[i + 1])) {
        one.written += "." + std::string(tokens[i + 1].text);
        i += 2;
      } else if (const std::size_t behind = tokens[i].is("[") ? take_index(tokens, i, one.written) : i; behind != i) {
        i = behind;
      } else {
        break;
      }
    }
    if (i < tokens.size() && tokens[i].is("[")) {
      continue;  // an element whose index is known at run time only
    }
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace

std::vector<LiveLine> live_lines(std::string_view text, const ValueOf& value_of) {
  std::vector<LiveLine> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line(text.substr(begin, end - begin));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) {
      line.pop_back();
    }
    lines.push_back({std::move(line), ""});
    begin = end + 1;
  }
  std::vector<std::vector<std::string>> shown(lines.size() + 1);
  for (const Mention& one : mentions_in(text)) {
    const auto line = static_cast<std::size_t>(one.line) - 1;
    const std::string path = upper(one.written);
    const std::string value = line < lines.size() ? value_of(path) : std::string();
    if (!value.empty() && std::find(shown[line].begin(), shown[line].end(), path) == shown[line].end()) {
      shown[line].push_back(path);
      lines[line].values += fmt::format("{}{} = {}", lines[line].values.empty() ? "" : "   ", one.written, value);
    }
  }
  return lines;
}

std::vector<std::string> paths_in(std::string_view text) {
  std::vector<std::string> paths;
  for (const Mention& one : mentions_in(text)) {
    paths.push_back(upper(one.written));
  }
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  return paths;
}

}  // namespace indurop::plc
