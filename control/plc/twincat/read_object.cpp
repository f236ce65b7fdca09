// SPDX-License-Identifier: Apache-2.0
#include "control/plc/twincat/read_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "control/plc/model/elementary.h"
#include "control/plc/plcopen/xml.h"
#include "control/plc/st/lexer.h"
#include "control/plc/st/parser.h"
#include "core/base/inside_folder.h"

namespace indurop::plc::twincat {
namespace {

using plcopen::Node;
using st::Token;
using st::TokenKind;

// The declaration of a POU has no end word, and its statements, methods and actions are stored separately. Their tokens
// are joined into one list in the order of the standard, each with its own place.
class Words {
 public:
  explicit Words(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Adds the tokens of <Declaration> or <ST>; none if it is null.
  void text(const Node* node) {
    if (node == nullptr) {
      return;
    }
    last_ = node->text_at;
    std::vector<Token> found = st::tokenize(node->text, node->text_at, diagnostics_);
    last_.line = found.back().line;
    last_.column = found.back().column;
    found.pop_back();  // the end
    std::move(found.begin(), found.end(), std::back_inserter(list_));
  }
  // Adds a word that the file omits, such as END_METHOD.
  void word(std::string_view text, TokenKind kind = TokenKind::Word) {
    list_.push_back({kind, text, text, last_.line, last_.column, {}, 0});
  }
  [[nodiscard]] std::vector<Token> take() {
    word({}, TokenKind::End);
    return std::move(list_);
  }
  [[nodiscard]] const std::vector<Token>& list() const noexcept { return list_; }

 private:
  Diagnostics& diagnostics_;
  std::vector<Token> list_;
  Place last_;
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kEnds{{{"PROGRAM", "END_PROGRAM"},
                                                                              {"FUNCTION", "END_FUNCTION"},
                                                                              {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK"},
                                                                              {"INTERFACE", "END_INTERFACE"}}};

std::string_view end_of(const std::vector<Token>& declaration) {
  for (const Token& token : declaration) {
    for (const auto& [word, end] : kEnds) {
      if (token.is(word)) {
        return end;
      }
    }
  }
  return "";
}

class TwinCatObjectReader {
 public:
  TwinCatObjectReader(const Place& at, std::vector<st::WrittenBody>& others, Diagnostics& diagnostics)
      : at_(at), others_(others), diagnostics_(diagnostics) {}

  Project read(const Node& root) {
    Project out;
    for (const Node& node : root.children) {
      if (node.name == "POU" || node.name == "Itf") {
        out = pou(node);
      } else if (node.name == "DUT" || node.name == "GVL") {
        Words words(diagnostics_);
        words.text(node.child("Declaration"));
        out = parsed(words);
        if (node.name == "GVL") {
          out.global_lists.emplace_back(node.attribute("Name"));
        }
      } else if (node.name == "Task") {
        task(node, out);
      } else {
        diagnostics_.error(node.at, fmt::format("<{}> is not a part of a PLC program, leave the file out", node.name));
      }
    }
    out.dialect = Dialect::Codesys;
    return out;
  }

 private:
  Project parsed(Words& words) {
    const std::vector<Token> tokens = words.take();
    return st::parse_tokens(tokens, at_, others_, diagnostics_);
  }

  Project pou(const Node& node) {
    Words words(diagnostics_);
    words.text(node.child("Declaration"));
    const std::string_view end = end_of(words.list());
    for (const Node& part : node.children) {
      if (part.name == "Method") {
        words.text(part.child("Declaration"));
        code(part, words);
        words.word("END_METHOD");
      } else if (part.name == "Property") {
        property(part, words);
      }
    }
    code(node, words);
    words.word(end);
    for (const Node& part : node.children) {
      if (part.name == "Action") {
        words.word("ACTION");
        words.word(part.attribute("Name"));
        words.word(":", TokenKind::Symbol);
        code(part, words);
        words.word("END_ACTION");
      }
    }
    return parsed(words);
  }

  void property(const Node& node, Words& words) {
    words.text(node.child("Declaration"));
    for (const auto& [part, end] : {std::pair("Get", "END_GET"), std::pair("Set", "END_SET")}) {
      if (const Node* accessor = node.child(part)) {
        words.word(part);
        words.text(accessor->child("Declaration"));
        code(*accessor, words);
        words.word(end);
      }
    }
    words.word("END_PROPERTY");
  }

  void code(const Node& node, Words& words) {
    const Node* code = node.child("Implementation");
    for (const Node& part : plcopen::children_of(code)) {
      if (part.name == "ST") {
        words.text(&part);
      } else {
        diagnostics_.error(part.at, fmt::format("{} is drawn in TwinCAT's own form, which is not supported; export the "
                                                "program as PLCopen XML and give that file instead",
                                                node.attribute("Name")));
      }
    }
  }

  static std::string text_of(const Node* node) {
    const std::string text = node == nullptr ? "" : node->text;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
  }

  static std::optional<std::int32_t> number_of(const Node* node) {
    const std::string text = text_of(node);
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return !text.empty() && error == std::errc{} && end == text.data() + text.size() ? std::optional(number)
                                                                                     : std::nullopt;
  }

  void task(const Node& node, Project& out) {
    Task made;
    made.at = node.at;
    made.name = std::string(node.attribute("Name"));
    const auto cycle = number_of(node.child("CycleTime"));  // in microseconds
    if (!cycle || *cycle <= 0) {
      diagnostics_.error(node.at, fmt::format("the task {} has no CycleTime in microseconds", made.name));
      return;
    }
    made.interval_ns = std::int64_t{*cycle} * 1000;
    made.priority = number_of(node.child("Priority"));
    Resource resource;
    resource.at = node.at;
    for (const Node& call : node.children) {
      if (call.name == "PouCall") {
        const std::string name = text_of(call.child("Name"));
        resource.programs.push_back({call.at, name, made.name, name});
      }
    }
    resource.tasks.push_back(std::move(made));
    Configuration& configuration = out.configurations.emplace_back();
    configuration.at = node.at;
    configuration.resources.push_back(std::move(resource));
  }

  const Place& at_;
  std::vector<st::WrittenBody>& others_;
  Diagnostics& diagnostics_;
};

network::Body written_body(const Node& node) {
  network::Body out;
  out.language = network::Body::Language::St;
  out.at = node.at;
  out.text_at = node.at;
  const Node* code = node.child("Implementation");
  if (const Node* text = code == nullptr ? nullptr : code->child("ST")) {
    out.text = text->text;
    out.text_at = text->text_at;
  }
  return out;
}

// Returns the statements of a <POU> and of its actions.
st::WrittenBody written_code(const Node& node) {
  st::WrittenBody out;
  out.code.body = written_body(node);
  for (const Node& part : node.children) {
    if (part.name == "Action") {
      out.code.actions.push_back({part.at, std::string(part.attribute("Name")), written_body(part)});
    }
  }
  return out;
}

std::optional<Node> read_root(std::string_view bytes, const Place& at, Diagnostics& diagnostics) {
  auto root = plcopen::read_xml(bytes, at.file, diagnostics);
  if (root && root->name != "TcPlcObject") {
    diagnostics.error(root->at,
                      fmt::format("<{}> is not an object of TwinCAT, whose root is <TcPlcObject>", root->name));
    return std::nullopt;
  }
  return root;
}

bool is_object(std::string_view file) {
  constexpr std::array<std::string_view, 5> kEndings{".TCPOU", ".TCDUT", ".TCGVL", ".TCIO", ".TCTTO"};
  const std::string capitals = upper(file);
  return std::any_of(kEndings.begin(), kEndings.end(), [&](std::string_view one) { return capitals.ends_with(one); });
}

void collect(const Node& node, std::vector<std::string>& out) {
  if (node.name == "Compile" && is_object(node.attribute("Include"))) {
    out.emplace_back(node.attribute("Include"));
  }
  for (const Node& child : node.children) {
    collect(child, out);
  }
}

}  // namespace

Project read_object(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& others,
                    Diagnostics& diagnostics) {
  const auto root = read_root(bytes, at, diagnostics);
  return root ? TwinCatObjectReader(at, others, diagnostics).read(*root) : Project();
}

Project read_declarations(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& bodies,
                          Diagnostics& diagnostics) {
  const auto root = read_root(bytes, at, diagnostics);
  if (!root) {
    return {};
  }
  std::vector<st::WrittenBody> others;
  Project out = TwinCatObjectReader(at, others, diagnostics).read(*root);
  const Node* pou = root->child("POU");
  if (pou != nullptr && out.pous.size() == 1) {  // a file has one
    out.pous.front().body.clear();
    bodies.push_back(written_code(*pou));
  }
  return out;
}

std::vector<std::string> files_of_project(std::string_view bytes, const Place& at, Diagnostics& diagnostics) {
  std::vector<std::string> out;
  const auto root = plcopen::read_xml(bytes, at.file, diagnostics);
  if (root) {
    collect(*root, out);
  }
  const std::string folder = at.file->substr(0, at.file->rfind('/') + 1);
  for (std::string& one : out) {
    std::replace(one.begin(), one.end(), '\\', '/');
    one.insert(0, folder);
    if (!base::lies_inside(one, folder.empty() ? "." : folder)) {
      diagnostics.error(at, fmt::format("this project names {}, which lies outside of its folder; put it there", one));
      one.clear();
    }
  }
  std::erase(out, "");
  if (root && out.empty() && !diagnostics.failed()) {
    diagnostics.error(at, "this project names no .TcPOU, .TcDUT, .TcGVL, .TcIO or .TcTTO files");
  }
  return out;
}

}  // namespace indurop::plc::twincat
