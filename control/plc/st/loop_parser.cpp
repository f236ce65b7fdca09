// SPDX-License-Identifier: Apache-2.0
// Parses FOR, WHILE and REPEAT, and the bodies of statements whose head has an error.
#include "control/plc/st/statement_parser.h"

namespace indurop::plc::st {

// Skips the word that ends the head of a statement, if it is there: the body is parsed although the head has an error.
void StatementParser::skip_header(std::string_view word) {
  const bool misspelled = in_.peek().kind == TokenKind::Word && !is_keyword(in_.peek().text) &&
                          in_.peek().line == in_.previous().line && in_.peek(1).line > in_.peek().line;
  if (misspelled) {  // IF a THAN
    in_.take();
    return;
  }
  for (std::size_t ahead = 0; in_.peek(ahead).kind != TokenKind::End; ++ahead) {
    const Token& token = in_.peek(ahead);
    if (token.is(";") || (token.is(":=") && ahead > 1) || TokenReader::is_end_word(token)) {
      return;
    }
    if (token.is(word)) {
      in_.skip_behind(word);
      return;
    }
  }
}

// Parses the body of a loop whose head has an error.
bool StatementParser::headless(Statement& out, std::string_view end) {
  skip_header("DO");
  out = {};
  out.kind = Statement::Kind::If;
  ast::Branch& branch = out.branches.emplace_back();
  branch.at = in_.here();
  branch.body = list({end});
  return in_.accept(end);
}

bool StatementParser::for_statement(Statement& out) {
  out.kind = Statement::Kind::For;
  if (!for_header(out)) {
    return headless(out, "END_FOR");
  }
  out.body = list({"END_FOR"});
  return in_.expect("END_FOR", fmt::format("to close the FOR of line {}", out.at.line));
}

// i := 1 TO 10 BY 2 DO
bool StatementParser::for_header(Statement& out) {
  if (!in_.expect_name("the loop's variable")) {
    return false;
  }
  out.target = expressions_.designator();
  if (!out.target || !in_.expect(":=", "after the loop's variable")) {
    return false;
  }
  out.value = expressions_.expression();
  if (!out.value || !in_.expect("TO", "after the first value")) {
    return false;
  }
  out.to = expressions_.expression();
  if (!out.to) {
    return false;
  }
  if (in_.accept("BY")) {
    out.by = expressions_.expression();
    if (!out.by) {
      return false;
    }
  }
  return in_.expect("DO", "before the statements of the loop");
}

bool StatementParser::while_statement(Statement& out) {
  out.kind = Statement::Kind::While;
  out.value = expressions_.expression();
  if (!out.value || !in_.expect("DO", "after the condition")) {
    return headless(out, "END_WHILE");
  }
  out.body = list({"END_WHILE"});
  return in_.expect("END_WHILE", fmt::format("to close the WHILE of line {}", out.at.line));
}

bool StatementParser::repeat_statement(Statement& out) {
  out.kind = Statement::Kind::Repeat;
  out.body = list({"UNTIL", "END_REPEAT"});
  if (!in_.expect("UNTIL", fmt::format("to close the REPEAT of line {}", out.at.line))) {
    return false;
  }
  out.value = expressions_.expression();
  in_.accept(";");
  return out.value && in_.expect("END_REPEAT", fmt::format("to close the REPEAT of line {}", out.at.line));
}

}  // namespace indurop::plc::st
