// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/print.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/draw/svg_picture.h"
#include "control/plc/draw/text_picture.h"
#include "control/plc/model/elementary.h"
#include "control/plc/print/chart_svg.h"
#include "control/plc/print/chart_text.h"

namespace indurop::plc {
namespace {

using Language = network::Body::Language;

const char* name_of(Language language) {
  switch (language) {
    case Language::None:
      return "no language";
    case Language::St:
      return "ST";
    case Language::Il:
      return "IL";
    case Language::Ld:
      return "LD";
    case Language::Fbd:
      return "FBD";
    case Language::Sfc:
      return "SFC";
  }
  return "";
}

const char* word_of(ast::Pou::Kind kind) {
  switch (kind) {
    case ast::Pou::Kind::Program:
      return "program";
    case ast::Pou::Kind::Function:
      return "function";
    case ast::Pou::Kind::FunctionBlock:
      return "function block";
    case ast::Pou::Kind::Class:
      return "class";
    case ast::Pou::Kind::Interface:
      return "interface";
    case ast::Pou::Kind::Method:
      return "method";
  }
  return "";
}

bool is_networks(const network::Body& body) {
  return body.language == Language::Ld || body.language == Language::Fbd;
}

void append_lines(std::vector<std::string>& lines, const std::string& text) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '\t')) {
      line.pop_back();
    }
    if (!line.empty()) {
      lines.push_back(std::move(line));
    }
    begin = end + 1;
  }
}

// Returns the networks of a chart that are more than an operand, and writes their numbers at the transitions they lead
// to.
std::vector<std::size_t> conditions_of(network::Diagram& diagram, const network::Sheet& sheet) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < sheet.networks.size(); ++i) {
    const auto& elements = sheet.networks[i].elements;
    if (elements.size() < 2 && (elements.empty() || elements[0]->kind == network::Element::Kind::InVariable)) {
      continue;
    }
    found.push_back(i);
    for (network::Element& each : diagram.elements) {
      const auto leads = [&](const network::Connection& connection) {
        return std::find(elements.begin(), elements.end(), diagram.find(connection.from)) != elements.end();
      };
      if (each.condition &&
          std::any_of(each.condition->connections.begin(), each.condition->connections.end(), leads)) {
        each.text = fmt::format("(network {})", sheet.networks[i].number);
      }
    }
  }
  return found;
}

// Code in a file is indented as in the editor; common white space is removed.
std::string code_text(const std::string& code) {
  std::vector<std::string> lines;
  append_lines(lines, code);
  std::size_t indent = std::string::npos;
  for (const std::string& line : lines) {
    indent = std::min(indent, line.find_first_not_of(" \t"));
  }
  std::string text;
  for (const std::string& line : lines) {
    text += "  " + line.substr(indent) + "\n";
  }
  return text;
}

std::string network_text(const network::Network& network, const draw::Picture& picture, Language language,
                         bool unicode) {
  std::string text = fmt::format("{} {}", network::word_of(language), network.number);
  for (const std::string& remark : remarks_of(network)) {
    text += (text.find('\n') == std::string::npos ? ": " : "        ") + remark + "\n";
  }
  text += text.back() == '\n' ? "" : "\n";
  for (const std::string& label : network.labels) {
    text += label + ":\n";
  }
  for (const draw::Row& row : draw::draw_text(picture, unicode)) {
    const std::string line = draw::plain(row);
    text += line.empty() ? "\n" : "  " + line + "\n";
  }
  return text + "\n";
}

}  // namespace

std::vector<std::string> remarks_of(const network::Network& network) {
  std::vector<std::string> lines;
  append_lines(lines, network.title);
  for (const std::string& comment : network.comments) {
    append_lines(lines, comment);
  }
  return lines;
}

std::vector<PrintedBody> printed_bodies(plcopen::Document& document, const std::string& pou) {
  std::vector<PrintedBody> bodies;
  for (plcopen::PouDocument& each : document.pous) {
    if (!pou.empty() && !same_name(pou, each.pou.name)) {
      continue;
    }
    const std::string what = "POU " + each.pou.name;
    bodies.push_back(
        {fmt::format("{}, {} in {}", each.pou.name, word_of(each.pou.kind), name_of(each.code.body.language)), what,
         &each.code.body});
    for (const auto& [word, list] :
         {std::pair{"action", &each.code.actions}, std::pair{"transition", &each.code.transitions}}) {
      for (network::NamedBody& named : *list) {
        bodies.push_back({fmt::format("{}, {} {} in {}", each.pou.name, word, named.name, name_of(named.body.language)),
                          fmt::format("{}, {} {}", what, word, named.name), &named.body});
      }
    }
  }
  return bodies;
}

std::string print_text(const std::vector<PrintedBody>& bodies, bool unicode, Diagnostics& diagnostics) {
  std::string text;
  for (const PrintedBody& each : bodies) {
    text += each.heading + "\n\n";
    if (each.body->language == Language::Sfc) {
      const network::Sheet sheet = network::make_sheet(*each.body, each.what, diagnostics);
      const std::vector<std::size_t> conditions = conditions_of(each.body->diagram, sheet);
      text += chart_text(network::read_chart(each.body->diagram, diagnostics), unicode);
      const auto pictures =
          conditions.empty() ? std::vector<draw::Picture>{} : draw::lay_out(sheet, *each.body, diagnostics);
      for (std::size_t k = 0; k < conditions.size() && !pictures.empty(); ++k) {
        const std::size_t i = conditions[k];
        text += network_text(sheet.networks[i], pictures[i], Language::Fbd, unicode);
      }
      continue;
    }
    if (!is_networks(*each.body)) {
      text += code_text(each.body->text) + "\n";
      continue;
    }
    const network::Sheet sheet = network::make_sheet(*each.body, each.what, diagnostics);
    if (diagnostics.failed()) {
      continue;
    }
    const auto pictures = draw::lay_out(sheet, *each.body, diagnostics);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      text += network_text(sheet.networks[i], pictures[i], each.body->language, unicode);
    }
  }
  return text;
}

std::string print_svg(const std::vector<PrintedBody>& bodies, Diagnostics& diagnostics) {
  std::vector<draw::SvgSheet> drawn;
  for (const PrintedBody& each : bodies) {
    const bool is_chart = each.body->language == Language::Sfc;
    if (!is_networks(*each.body) && !is_chart) {
      continue;
    }
    const network::Sheet sheet = network::make_sheet(*each.body, each.what, diagnostics);
    const std::vector<std::size_t> conditions =
        is_chart ? conditions_of(each.body->diagram, sheet) : std::vector<std::size_t>{};
    const network::Chart chart = is_chart ? network::read_chart(each.body->diagram, diagnostics) : network::Chart{};
    if (diagnostics.failed()) {
      continue;
    }
    draw::SvgSheet& made = drawn.emplace_back();
    made.heading = each.heading;
    constexpr std::size_t kMostSteps = 5000;
    if (chart.steps.size() + chart.transitions.size() > kMostSteps) {
      diagnostics.error(each.body->at, "this chart is too large for a picture; print it as text");
      continue;
    }
    if (is_chart) {
      made.chart = draw_chart(chart);
    }
    auto pictures = draw::lay_out(sheet, *each.body, diagnostics);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (is_chart && std::find(conditions.begin(), conditions.end(), i) == conditions.end()) {
        continue;
      }
      const network::Network& network = sheet.networks[i];
      made.networks.push_back({network.number, remarks_of(network), network.labels, std::move(pictures[i])});
    }
  }
  return draw::draw_svg(drawn);
}

}  // namespace indurop::plc
