// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/text_picture.h"

#include <algorithm>

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;
using Look = Run::Look;

class TextDrawing {
 public:
  TextDrawing(const Picture& picture, bool unicode, const Live& live)
      : picture_(picture), live_(live), canvas_(picture.width, picture.height, unicode) {}

  std::vector<Row> run() {
    if (picture_.rails) {
      canvas_.vertical(1, 0, 2 * picture_.height, -1, live_.powered != nullptr);
      canvas_.vertical(2 * picture_.width - 1, 0, 2 * picture_.height, -1, false);
    }
    for (const Line& line : picture_.lines) {
      const bool on = powered(line.sources);
      if (line.y1 == line.y2) {
        canvas_.horizontal(line.x1, line.x2, line.y1, line.net, on);
      } else {
        canvas_.vertical(line.x1, line.y1, line.y2, line.net, on);
      }
    }
    for (const Symbol& symbol : picture_.symbols) {
      draw(symbol);
    }
    return canvas_.rows();
  }

 private:
  [[nodiscard]] bool powered(const std::vector<Source>& sources) const {
    return live_.powered != nullptr && std::any_of(sources.begin(), sources.end(), live_.powered);
  }

  void draw(const Symbol& symbol) {
    if (symbol.element == nullptr) {
      canvas_.text(symbol.x + (symbol.shape.inputs.empty() ? 0 : 1), symbol.y, symbol.text);
      return;
    }
    const Element& element = *symbol.element;
    switch (element.kind) {
      case Kind::Contact:
        switch_symbol(symbol, "┤", "├", "[", "]");
        break;
      case Kind::Coil:
        switch_symbol(symbol, "(", ")", "(", ")");
        break;
      case Kind::Block:
        block(symbol);
        break;
      case Kind::OutVariable:
        canvas_.text(symbol.x + 1, symbol.y, shown_text(element));
        break;
      case Kind::InOutVariable:
        canvas_.text(symbol.x, symbol.y, "[ " + shown_text(element) + " ]");
        break;
      case Kind::Jump:
        canvas_.text(symbol.x, symbol.y, ">> " + element.text);
        break;
      case Kind::Return:
        canvas_.text(symbol.x, symbol.y, "<RETURN>");
        break;
      case Kind::Connector:
        canvas_.text(symbol.x, symbol.y, "> " + element.text);
        break;
      case Kind::Continuation:
        canvas_.text(symbol.x, symbol.y, element.text + " >");
        break;
      default:
        canvas_.text(symbol.x, symbol.y, shown_text(element));
    }
  }

  void switch_symbol(const Symbol& symbol, const char* left, const char* right, const char* ascii_left,
                     const char* ascii_right) {
    const Element& element = *symbol.element;
    const bool closed = live_.closed != nullptr && live_.closed(element);
    const Look look = closed ? Look::Powered : Look::Plain;
    const int name = symbol.x + (symbol.shape.width - text_width(element.text)) / 2;
    canvas_.text(name, symbol.y, element.text, closed ? Look::Powered : Look::Name);
    const int x = symbol.x + symbol_begin(symbol.shape);
    canvas_.mark(x, symbol.y + 1, left, ascii_left, look);
    canvas_.text(x + 1, symbol.y + 1, mark_of(element), look);
    canvas_.mark(x + 2, symbol.y + 1, right, ascii_right, look);
  }

  void block(const Symbol& symbol) {
    const Element& element = *symbol.element;
    const int right = symbol.x + symbol.shape.width - 1;
    const int top = symbol.y + border_line(element);
    const int bottom = symbol.y + symbol.shape.height - 1;
    canvas_.text(symbol.x + (symbol.shape.width - text_width(element.instance)) / 2, symbol.y, element.instance,
                 Look::Name);
    for (const int y : {top, bottom}) {
      canvas_.horizontal(2 * symbol.x + 1, 2 * right + 1, 2 * y + 1, -1, false);
    }
    for (const int x : {symbol.x, right}) {
      canvas_.vertical(2 * x + 1, 2 * top + 1, 2 * bottom + 1, -1, false);
    }
    canvas_.text(symbol.x + (symbol.shape.width - text_width(element.type)) / 2, top, element.type);
    pins(element, element.inputs, symbol, 0, true);
    pins(element, element.in_outs, symbol, element.inputs.size(), true);
    pins(element, element.outputs, symbol, 0, false);
    pins(element, element.in_outs, symbol, element.outputs.size(), false);
  }

  void pins(const Element& element, const std::vector<Pin>& list, const Symbol& symbol, std::size_t first, bool left) {
    const int right = symbol.x + symbol.shape.width - 1;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Pin& pin = list[i];
      const int y = symbol.y + (left ? symbol.shape.inputs : symbol.shape.outputs)[first + i];
      const int border = left ? symbol.x : right;
      canvas_.text(left ? symbol.x + 1 : right - text_width(pin.name), y, pin.name);
      if (pin.negated) {
        canvas_.mark(left ? border - 1 : border + 1, y, "○", "o");
      }
      if (pin.edge != ast::Edge::None) {
        canvas_.text(border, y, pin.edge == ast::Edge::Rising ? ">" : "<");
      }
      if (!left && live_.value != nullptr) {
        canvas_.text(right + 1, y - 1, live_.value({&element, &pin}), Look::Value);
      }
    }
  }

  const Picture& picture_;
  const Live& live_;
  Canvas canvas_;
};

}  // namespace

std::vector<Row> draw_text(const Picture& picture, bool unicode, const Live& live) {
  return TextDrawing(picture, unicode, live).run();
}

}  // namespace indurop::plc::draw
