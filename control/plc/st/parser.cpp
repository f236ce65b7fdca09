// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/parser.h"

#include "control/plc/st/project_parser.h"

namespace indurop::plc::st {
namespace {

// Returns the result of `parse` if nothing follows it.
template <class Parse>
auto alone(const Text& text, Diagnostics& diagnostics, Parse parse) -> decltype(parse(std::declval<TokenReader&>())) {
  const auto tokens = tokenize(text.text, text.at, diagnostics);
  TokenReader in(tokens, text.at, diagnostics);
  auto out = parse(in);
  if (out && !in.at_end()) {
    in.error(in.peek(), fmt::format("{} is too much here, remove it", TokenReader::spelled(in.peek())));
    return std::nullopt;
  }
  return out;
}

Project parse(const Text& text, Bodies wanted, std::vector<WrittenBody>& bodies, Diagnostics& diagnostics) {
  const auto tokens = tokenize(text.text, text.at, diagnostics);
  TokenReader in(tokens, text.at, diagnostics);
  ProjectParser parser(in, text.in_editor, wanted);
  Project project = parser.project();
  bodies = parser.take_written();
  return project;
}

}  // namespace

Project parse_project(const Text& text, std::vector<WrittenBody>& others, Diagnostics& diagnostics) {
  return parse(text, Bodies::Parsed, others, diagnostics);
}

Project parse_declarations(const Text& text, std::vector<WrittenBody>& bodies, Diagnostics& diagnostics) {
  return parse(text, Bodies::AsWritten, bodies, diagnostics);
}

Project parse_tokens(const std::vector<Token>& tokens, const Place& at, std::vector<WrittenBody>& others,
                     Diagnostics& diagnostics) {
  TokenReader in(tokens, at, diagnostics);
  ProjectParser parser(in);
  Project project = parser.project();
  others = parser.take_written();
  return project;
}

ast::Body parse_body(const Text& text, std::optional<Place>& c_code, Diagnostics& diagnostics) {
  const auto tokens = tokenize(text.text, text.at, diagnostics);
  TokenReader in(tokens, text.at, diagnostics);
  return ProjectParser(in).whole_body(c_code);
}

std::optional<ast::Expression> parse_expression(const Text& text, Diagnostics& diagnostics) {
  return alone(text, diagnostics, [](TokenReader& in) { return ExpressionParser(in).expression(); });
}

std::optional<ast::TypeSpec> parse_type(const Text& text, Diagnostics& diagnostics) {
  return alone(text, diagnostics, [](TokenReader& in) { return DeclarationParser(in).type(); });
}

std::optional<ast::Initial> parse_initial(const Text& text, Diagnostics& diagnostics) {
  return alone(text, diagnostics, [](TokenReader& in) { return ExpressionParser(in).initial(); });
}

}  // namespace indurop::plc::st
