// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/st_text.h"

#include <fmt/format.h>

#include "control/plc/print/expression_text.h"

namespace indurop::plc {
namespace {

using ast::Statement;

class TextWriter {
 public:
  void list(const ast::Body& body, int depth) {
    for (const Statement& each : body) {
      statement(each, depth);
    }
  }

  std::string take() { return std::move(out_); }

 private:
  void line(int depth, std::string_view text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + std::string(text) + "\n";
  }

  void statement(const Statement& each, int depth) {
    if (!each.comment.empty()) {
      line(depth, "(* " + each.comment + " *)");
    }
    switch (each.kind) {
      case Statement::Kind::Empty:
        break;
      case Statement::Kind::Assign:
        line(depth, expression_text(*each.target) + " := " + expression_text(*each.value) + ";");
        break;
      case Statement::Kind::Call:
        line(depth, expression_text(*each.value) + ";");
        break;
      case Statement::Kind::If:
        branches(each, depth);
        break;
      case Statement::Kind::Label:
        line(depth, each.label + ":");
        break;
      case Statement::Kind::Jump:
      case Statement::Kind::Return: {
        const std::string where = each.kind == Statement::Kind::Jump ? "JMP " + each.label : std::string("RETURN");
        line(depth, each.value ? "IF " + expression_text(*each.value) + " THEN " + where + "; END_IF;" : where + ";");
        break;
      }
      case Statement::Kind::Exit:
        line(depth, "EXIT;");
        break;
      case Statement::Kind::Continue:
        line(depth, "CONTINUE;");
        break;
      case Statement::Kind::Case:
      case Statement::Kind::For:
      case Statement::Kind::While:
      case Statement::Kind::Repeat:
        loop(each, depth);
        break;
    }
  }

  void branches(const Statement& each, int depth) {
    bool first = true;
    for (const ast::Branch& branch : each.branches) {
      line(depth, branch.condition ? (first ? "IF " : "ELSIF ") + expression_text(*branch.condition) + " THEN"
                                   : std::string("ELSE"));
      list(branch.body, depth + 1);
      first = false;
    }
    line(depth, "END_IF;");
  }

  void loop(const Statement& each, int depth) {
    switch (each.kind) {
      case Statement::Kind::For:
        line(depth, fmt::format("FOR {} := {} TO {}{} DO", expression_text(*each.target), expression_text(*each.value),
                                expression_text(*each.to), each.by ? " BY " + expression_text(*each.by) : ""));
        list(each.body, depth + 1);
        line(depth, "END_FOR;");
        break;
      case Statement::Kind::While:
        line(depth, "WHILE " + expression_text(*each.value) + " DO");
        list(each.body, depth + 1);
        line(depth, "END_WHILE;");
        break;
      case Statement::Kind::Repeat:
        line(depth, "REPEAT");
        list(each.body, depth + 1);
        line(depth, "UNTIL " + expression_text(*each.value) + " END_REPEAT;");
        break;
      default:
        cases(each, depth);
    }
  }

  void cases(const Statement& each, int depth) {
    line(depth, "CASE " + expression_text(*each.value) + " OF");
    for (const ast::Branch& branch : each.branches) {
      std::string labels;
      for (const ast::CaseLabel& label : branch.labels) {
        labels += (labels.empty() ? "" : ", ") + expression_text(label.low) +
                  (label.high ? ".." + expression_text(*label.high) : "");
      }
      line(depth + 1, labels.empty() ? "ELSE" : labels + ":");
      list(branch.body, depth + 2);
    }
    line(depth, "END_CASE;");
  }

  std::string out_;
};

}  // namespace

std::string st_text(const ast::Pou& pou) {
  TextWriter writer;
  writer.list(pou.body, 1);
  return pou.name + "\n" + writer.take();
}

}  // namespace indurop::plc
