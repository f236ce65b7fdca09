// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_view_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "control/plc/draw/text_picture.h"
#include "control/plc/print/chart_text.h"
#include "control/plc/print/live_text.h"
#include "control/plc/print/print.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using plc::draw::Run;

Style style_of(Run::Look look) {
  switch (look) {
    case Run::Look::Powered:
      return Style::Good;
    case Run::Look::Value:
      return Style::Accent;
    case Run::Look::Plain:
    case Run::Look::Name:
      break;
  }
  return Style::None;
}

void text_lines(const PlcView& view, const Output& out, const PlcView::Shown& shown, std::vector<std::string>& lines) {
  lines.push_back(
      out.paint(Style::Dim, shown.title + (shown.body->action.empty() ? "" : ", action " + shown.body->action)));
  const auto text = plc::live_lines(first_indent(*shown.body) + shown.body->body->text,
                                    [&](const std::string& path) { return view.value(shown, path); });
  constexpr int kMaxWidth = 60;
  int width = 0;
  for (const plc::LiveLine& one : text) {
    width = std::max(width, one.values.empty() ? 0 : std::min(kMaxWidth, plc::draw::text_width(one.text)));
  }
  for (const plc::LiveLine& one : text) {
    const int room = std::max(0, width - plc::draw::text_width(one.text));
    lines.push_back(one.values.empty() ? one.text
                                       : one.text + std::string(static_cast<std::size_t>(room), ' ') + "  " +
                                             out.paint(Style::Accent, printable(one.values)));
  }
  lines.emplace_back();
}

void chart_lines(const PlcView& view, const Output& out, const PlcView::Shown& shown, std::vector<std::string>& lines) {
  lines.push_back(out.paint(Style::Dim, shown.title));
  const bool unicode = out.unicode();
  plc::ChartMarks marks;
  marks.step = [&](const plc::network::Step& step) {
    const std::string name = plc::upper(step.name);
    return view.flag(shown, name, 0) ? out.paint(Style::Good, fmt::format(" {} active {}", unicode ? "●" : "*",
                                                                          view.value(shown, name + ".T")))
                                     : std::string();
  };
  marks.condition = [&](const std::string& condition) {
    const auto values_of = plc::live_lines(condition, [&](const std::string& path) { return view.value(shown, path); });
    return values_of.empty() || values_of[0].values.empty()
               ? std::string()
               : "  " + out.paint(Style::Accent, printable(values_of[0].values));
  };
  const std::string text = plc::chart_text(*shown.body->chart, unicode, marks);
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
}

void network(const PlcView& view, const Output& out, const PlcView::Shown& shown, std::size_t number,
             std::vector<std::string>& lines) {
  const plc::LiveBody& body = *shown.body;
  const auto& drawn = body.sheet->networks[number];
  const auto remarks = plc::remarks_of(drawn);
  lines.push_back(out.paint(
      Style::Dim, fmt::format("{}{} {} {}{}{}", shown.title, body.action.empty() ? "" : ", action " + body.action,
                              plc::network::word_of(body.body->language), drawn.number, remarks.empty() ? "" : ": ",
                              remarks.empty() ? "" : printable(remarks.front()))));
  for (const auto& row : plc::draw::draw_text(body.pictures[number], out.unicode(), view.live_of(shown))) {
    std::string line = "  ";
    for (const Run& run : row) {
      line += out.paint(style_of(run.look), run.text);
    }
    lines.push_back(std::move(line));
  }
  lines.emplace_back();
}

void network_lines(const PlcView& view, const Output& out, const PlcView::Shown& shown,
                   std::vector<std::string>& lines) {
  for (std::size_t n = 0; n < shown.body->pictures.size(); ++n) {
    if (view.rung() == 0 || view.rung() == shown.body->sheet->networks[n].number) {
      network(view, out, shown, n, lines);
    }
  }
}

}  // namespace

std::string heading_of(const PlcView& view, const Output& out) {
  return out.paint(Style::Bold, "node " + view.source().node()) + "  " +
         (view.source().alive() ? out.paint(Style::Good, "running") : out.paint(Style::Bad, view.source().absence()));
}

std::vector<std::string> lines_of(const PlcView& view, const Output& out) {
  std::vector<std::string> lines;
  if (!view.others().empty()) {
    lines.push_back(out.paint(Style::Dim, fmt::format("--instance shows also {}", view.others())));
  }
  for (const PlcView::Shown& shown : view.shown()) {
    if (shown.body->drawn()) {
      network_lines(view, out, shown, lines);
    } else if (view.rung() == 0 && shown.body->chart) {
      chart_lines(view, out, shown, lines);
    } else if (view.rung() == 0 && is_text(*shown.body)) {
      text_lines(view, out, shown, lines);
    }
  }
  return lines;
}

}  // namespace indurop::tools
