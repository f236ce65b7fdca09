// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/svg_symbols.h"

#include <fmt/format.h>

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;

constexpr const char* kStroke = "stroke=\"#1F2D3D\" stroke-width=\"1.6\" fill=\"none\" stroke-linecap=\"square\"";
constexpr const char* kBold = R"(stroke="#1F2D3D" stroke-width="2" fill="none")";
constexpr const char* kName = "fill=\"#0B4A8F\"";
constexpr const char* kValue = "fill=\"#8A4B08\"";

std::string move_to(double x, double y) {
  return fmt::format("M{} {}", base::svg_number(x), base::svg_number(y));
}

class SymbolDrawing {
 public:
  explicit SymbolDrawing(base::SvgPart& out) : out_(out) {}

  void run(const Symbol& symbol) {
    if (symbol.element == nullptr) {
      const bool source = symbol.shape.inputs.empty();
      value(symbol, symbol.text, source);
      return;
    }
    const Element& element = *symbol.element;
    switch (element.kind) {
      case Kind::Contact:
      case Kind::Coil:
        switch_symbol(symbol);
        break;
      case Kind::Block:
        block(symbol);
        break;
      case Kind::InOutVariable:
        box_around(symbol, shown_text(element));
        break;
      case Kind::Return:
        value(symbol, "RETURN", false);
        break;
      case Kind::Jump:
      case Kind::Connector:
        value(symbol, "» " + element.text, false);
        break;
      case Kind::Continuation:
        value(symbol, element.text + " »", true);
        break;
      default:
        value(symbol, shown_text(element), symbol.shape.inputs.empty());
    }
  }

 private:
  void text(double x, double y, std::string_view text, const char* anchor, const char* attributes) {
    out_.text(x, y, text, fmt::format("text-anchor=\"{}\" {}", anchor, attributes));
  }

  void switch_symbol(const Symbol& symbol) {
    const Element& element = *symbol.element;
    const double x = half_x(2 * (symbol.x + symbol_begin(symbol.shape)));
    const double y = half_y(2 * symbol.y + 3);
    const double middle = x + half_x(kSymbolWidth);
    const bool coil = element.kind == Kind::Coil;
    text(middle, half_y(2 * symbol.y) + 15, element.text, "middle", kName);
    out_.path(fmt::format("{}h{}", move_to(x, y), coil ? 4 : 8), kStroke);
    out_.path(fmt::format("{}h{}", move_to(x + 27, y), coil ? -4 : -8), kStroke);
    if (coil) {
      out_.path(fmt::format("{}q-9 9 0 18{}q9 9 0 18", move_to(x + 8.5, y - 9), move_to(x + 18.5, y - 9)), kBold);
    } else {
      out_.path(fmt::format("{}v18{}v18", move_to(x + 8, y - 9), move_to(x + 19, y - 9)), kBold);
    }
    const std::string_view mark = mark_of(element);
    if (mark == "/") {
      out_.path(fmt::format("{}l8 -16", move_to(x + 9.5, y + 8)), kStroke);
    } else if (mark != " ") {
      text(middle, y + 4, mark, "middle", "font-size=\"11\" font-weight=\"bold\" fill=\"#1F2D3D\"");
    }
  }

  void block(const Symbol& symbol) {
    const Element& element = *symbol.element;
    const double left = half_x(2 * symbol.x + 1);
    const double right = half_x(2 * (symbol.x + symbol.shape.width) - 1);
    const double top = half_y(2 * (symbol.y + border_line(element))) + 1;
    const double bottom = half_y(2 * (symbol.y + symbol.shape.height) - 1);
    const double middle = (left + right) / 2;
    text(middle, top - 5, element.instance, "middle", kName);
    out_.rect(left, top, right - left, bottom - top, R"(rx="3" fill="#F2F6FB" stroke="#2B4C7E" stroke-width="1.6")");
    text(middle, top + 14, element.type, "middle", "font-weight=\"bold\" fill=\"#2B4C7E\"");
    pins(element.inputs, symbol, 0, true, left);
    pins(element.in_outs, symbol, element.inputs.size(), true, left);
    pins(element.outputs, symbol, 0, false, right);
    pins(element.in_outs, symbol, element.outputs.size(), false, right);
  }

  void pins(const std::vector<Pin>& list, const Symbol& symbol, std::size_t first, bool left, double border) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double y = half_y(2 * (symbol.y + (left ? symbol.shape.inputs : symbol.shape.outputs)[first + i]) + 1);
      const bool edge = list[i].edge != ast::Edge::None;
      const double inside = edge ? 11 : 6;
      text(left ? border + inside : border - inside, y + 4, list[i].name, left ? "start" : "end",
           "font-size=\"11\" fill=\"#1F2D3D\"");
      if (list[i].negated) {
        out_.circle(left ? border - 4 : border + 4, y, 4, R"(fill="#FFFFFF" stroke="#2B4C7E" stroke-width="1.6")");
      }
      if (edge) {
        const bool rising = list[i].edge == ast::Edge::Rising;
        out_.path(
            fmt::format("{}l{} 5l{} 5", move_to(rising ? border : border + 8, y - 5), rising ? 8 : -8, rising ? -8 : 8),
            kStroke);
      }
    }
  }

  void value(const Symbol& symbol, const std::string& shown, bool source) {
    const double y = half_y(2 * symbol.y + 1) + 4;
    if (source) {
      text(half_x(2 * (symbol.x + symbol.shape.width)) - 5, y, shown, "end", kValue);
    } else {
      text(half_x(2 * symbol.x) + 5, y, shown, "start", kValue);
    }
  }

  void box_around(const Symbol& symbol, const std::string& shown) {
    const double x = half_x(2 * symbol.x);
    const double width = half_x(2 * symbol.shape.width);
    out_.rect(x, half_y(2 * symbol.y) + 1, width, 18, R"(rx="3" fill="#FFF8EC" stroke="#8A4B08")");
    text(x + width / 2, half_y(2 * symbol.y + 1) + 4, shown, "middle", kValue);
  }

  base::SvgPart& out_;
};

}  // namespace

void svg_symbol(const Symbol& symbol, base::SvgPart& out) {
  SymbolDrawing(out).run(symbol);
}

}  // namespace indurop::plc::draw
