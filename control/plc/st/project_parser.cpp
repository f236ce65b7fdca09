// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/project_parser.h"

namespace indurop::plc::st {
namespace {

std::string_view word_of(ast::Pou::Kind kind) noexcept {
  switch (kind) {
    case ast::Pou::Kind::Program:
      return "PROGRAM";
    case ast::Pou::Kind::Function:
      return "FUNCTION";
    case ast::Pou::Kind::FunctionBlock:
      return "FUNCTION_BLOCK";
    case ast::Pou::Kind::Class:
    case ast::Pou::Kind::Interface:
    case ast::Pou::Kind::Method:
      break;
  }
  return "";
}

// Consumes END_PROGRAM and so on, which editors omit at the end of the text.
void take_end(TokenReader& in, const ast::Pou& pou, int line, std::string_view end, bool may_miss) {
  if (may_miss && in.at_end()) {
    in.warning(pou.at, fmt::format("{} has no {}, which is taken to stand at the end of the text", pou.name, end));
  } else if (in.at_end()) {
    in.error(in.peek(), fmt::format("the {} of line {} has no {}; add it, or if the text comes out of the editor of "
                                    "CODESYS, which leaves it away, say --dialect codesys",
                                    word_of(pou.kind), line, end));
  } else if (in.expect(end, fmt::format("to close the {} of line {}", word_of(pou.kind), line))) {
    in.accept(";");
  }
}

}  // namespace

Project ProjectParser::project() {
  Project out;
  bool complained = false;  // one message for each run of unknown text
  while (!in_.at_end()) {
    bool known = element(out);
    if (!known) {
      const Token& token = in_.take();
      known = token.is(";");
      if (!known && !complained) {
        in_.error(token, fmt::format("expected PROGRAM, FUNCTION, FUNCTION_BLOCK, TYPE, VAR_GLOBAL or CONFIGURATION, "
                                     "found {}",
                                     TokenReader::spelled(token)));
      }
    }
    complained = !known;
  }
  out.accesses.insert(out.accesses.end(), std::make_move_iterator(accesses_.begin()),
                      std::make_move_iterator(accesses_.end()));
  out.incomplete = in_.left_out();
  return out;
}

// Parses an element of a namespace, or of the whole text. Returns false if none begins here.
bool ProjectParser::element(Project& out) {
  const std::size_t types = out.types.size();
  const std::size_t pous = out.pous.size();
  if (in_.accept("PROGRAM")) {
    pou(ast::Pou::Kind::Program, out.pous);
  } else if (in_.accept("FUNCTION")) {
    pou(ast::Pou::Kind::Function, out.pous);
  } else if (in_.accept("FUNCTION_BLOCK") || in_.accept("FUNCTIONBLOCK")) {  // CODESYS 2.3 has both
    pou(ast::Pou::Kind::FunctionBlock, out.pous);
  } else if (in_.accept("TYPE")) {
    declarations_.types(out.types);
  } else if (in_.accept("CLASS")) {
    object(ast::Pou::Kind::Class, out.pous);
  } else if (in_.accept("INTERFACE")) {
    object(ast::Pou::Kind::Interface, out.pous);
  } else if (in_.peek().is("NAMESPACE")) {
    space(out);
    return true;
  } else if (in_.peek().is("USING") && in_.peek(1).kind == TokenKind::Word) {
    using_directive(scope_.uses);
  } else if (scope_.space.empty() && in_.peek().is("VAR_GLOBAL")) {
    declarations_.variables(out.globals);
  } else if (scope_.space.empty() && (in_.next_is({"CONFIGURATION", "VAR_CONFIG", "VAR_ACCESS"}))) {
    configurations_.element(out);
  } else {
    return false;
  }
  for (std::size_t i = types; i < out.types.size(); ++i) {
    out.types[i].scope = scope_;
  }
  for (std::size_t i = pous; i < out.pous.size(); ++i) {
    ast::Scope& own = out.pous[i].scope;
    own.space = scope_.space;
    own.uses.insert(own.uses.end(), scope_.uses.begin(), scope_.uses.end());
  }
  return true;
}

// Returns whether there are ACTIONs in this POU or after it.
bool ProjectParser::has_actions(std::string_view end) {
  std::size_t& next = next_end_[std::string(end)];  // so the text after each POU is not searched again
  next = std::max(next, in_.position());
  const auto ahead = [&](std::size_t more) -> const Token& { return in_.peek(next - in_.position() + more); };
  while (ahead(0).kind != TokenKind::End && !ahead(0).is("ACTION") && !ahead(0).is(end)) {
    ++next;
  }
  return ahead(0).is("ACTION") ||
         (ahead(0).is(end) && (ahead(1).is("ACTION") || (ahead(1).is(";") && ahead(2).is("ACTION"))));
}

bool ProjectParser::name(std::string& to, std::string_view what) {
  if (!in_.expect_name(what)) {
    return false;
  }
  to = in_.take().text;
  return true;
}

void ProjectParser::pou(ast::Pou::Kind kind, std::vector<ast::Pou>& to) {
  const Token& word = in_.previous();
  const std::string end = fmt::format("END_{}", word_of(kind));
  ast::Pou out;
  out.kind = kind;
  out.comment = word.comment;
  modifiers(out);
  out.at = in_.here();
  bool ok = name(out.name, kind == ast::Pou::Kind::Program ? "the program" : "a function or function block");
  uses(out);
  inheritance(out);
  if (ok && kind == ast::Pou::Kind::Function && in_.accept(":")) {
    out.result = declarations_.type();
    ok = out.result.has_value();
    in_.accept(";");
  }
  uses(out);
  if (!ok) {
    while (!in_.at_end() && !in_.peek().is(end) && !declarations_.at_variables()) {
      in_.take();
    }
  }
  while (declarations_.at_variables()) {
    if (kind == ast::Pou::Kind::Program && in_.peek().is("VAR_ACCESS")) {
      configurations_.accesses(out.name, accesses_);
    } else {
      declarations_.variables(out.variables);
    }
  }
  methods(out);
  ChartParser chart(in_);
  std::optional<WrittenBody> written;
  if (chart.at_chart()) {
    written = chart.chart(end);
  } else if (chart.at_instruction_list()) {
    written = chart.instruction_list(end);
  } else if (has_actions(end)) {
    written = chart.statements(end);
  } else {
    written = statements(out, end);
  }
  methods(out);
  take_end(in_, out, word.line, end, in_editor_);
  if (written) {
    chart.actions(*written);
    written->pou = to.size();
  }
  methods(out);
  if (written && ok) {
    written_.push_back(std::move(*written));
  }
  out.c_code = statements_.take_c_code();
  if (ok) {
    to.push_back(std::move(out));
  }
}

// Parses the body in Structured Text, or keeps its text.
std::optional<WrittenBody> ProjectParser::statements(ast::Pou& out, std::string_view end) {
  const Token& before = in_.previous();
  out.body = body(end);
  if (!as_written_) {
    return std::nullopt;
  }
  out.body.clear();
  return text_behind(before);
}

// Returns the text after the token up to here, comments included.
WrittenBody ProjectParser::text_behind(const Token& before) const {
  const char* begin = before.written.data() + before.written.size();
  WrittenBody made;
  network::Body& body = made.code.body;
  body.language = network::Body::Language::St;
  body.at = in_.place(before);
  body.text_at = body.at;
  body.text_at.column += static_cast<int>(before.written.size());
  body.text.assign(begin, static_cast<std::size_t>(in_.peek().written.data() - begin));
  return made;
}

ast::Body ProjectParser::whole_body(std::optional<Place>& c_code) {
  ast::Body out = body("");
  const auto at = statements_.take_c_code();
  c_code = c_code ? c_code : at;
  return out;
}

ast::Body ProjectParser::body(std::string_view end) {
  ast::Body out = statements_.list({end, "METHOD"});
  while (!in_.at_end() && !in_.peek().is(end) && !at_method()) {
    const Token& stray = in_.peek();
    if (stray.is("END_PROGRAM") || stray.is("END_FUNCTION") || stray.is("END_FUNCTION_BLOCK")) {
      break;
    }
    in_.take();
    in_.error(stray,
              fmt::format("{} without its beginning, remove it or add the beginning", TokenReader::spelled(stray)));
    in_.accept(";");
    ast::Body rest = statements_.list({end});
    out.insert(out.end(), std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
  }
  return out;
}

}  // namespace indurop::plc::st
