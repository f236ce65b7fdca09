// SPDX-License-Identifier: Apache-2.0
// The drawings of PlcView for programs that draw themselves: SVG without power, and the places at which power, values
// and active steps are to be shown. Changing data comes in the same order, so that both match without names.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "control/plc/draw/svg_symbols.h"
#include "control/plc/print/chart_svg.h"
#include "control/plc/print/chart_text.h"
#include "control/plc/print/live_text.h"
#include "control/plc/print/print.h"
#include "tools/client/plc/plc_view.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using plc::draw::half_x;
using plc::draw::half_y;
using plc::network::Body;
using plc::network::Element;

std::string language_of(Body::Language language) {
  switch (language) {
    case Body::Language::St:
      return "ST";
    case Body::Language::Il:
      return "IL";
    case Body::Language::Ld:
      return "LD";
    case Body::Language::Fbd:
      return "FBD";
    case Body::Language::Sfc:
      return "SFC";
    case Body::Language::None:
      break;
  }
  return "";
}

bool is_switch(const plc::draw::Symbol& symbol) {
  return symbol.element != nullptr &&
         (symbol.element->kind == Element::Kind::Contact || symbol.element->kind == Element::Kind::Coil);
}

// Calls `use` with each output of a block and the position right above its line.
template <class Use>
void for_each_output(const plc::draw::Picture& picture, Use use) {
  for (const plc::draw::Symbol& symbol : picture.symbols) {
    if (symbol.element == nullptr || symbol.element->kind != Element::Kind::Block) {
      continue;
    }
    const auto& outputs = symbol.element->outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const int y = symbol.y + symbol.shape.outputs[i];
      use(plc::network::Source{symbol.element, &outputs[i]}, half_x(2 * (symbol.x + symbol.shape.width)),
          half_y(2 * y + 1) - 4);
    }
  }
}

JsonValue array_of(std::initializer_list<double> numbers) {
  JsonValue out = JsonValue::array();
  for (const double number : numbers) {
    out.push_back(number);
  }
  return out;
}

JsonValue picture_of(const plc::draw::Picture& picture) {
  const plc::draw::SvgPart part = plc::draw::draw_network(picture);
  JsonValue out = JsonValue::object();
  out["svg"] = part.elements.elements();
  out["width"] = part.width;
  out["height"] = part.height;
  out["rail"] = picture.rails;
  JsonValue wires = JsonValue::array();
  for (const plc::draw::Line& line : picture.lines) {
    wires.push_back(array_of({half_x(line.x1), half_y(line.y1), half_x(line.x2), half_y(line.y2)}));
  }
  out["wires"] = std::move(wires);
  JsonValue switches = JsonValue::array();
  for (const plc::draw::Symbol& symbol : picture.symbols) {
    if (is_switch(symbol)) {
      JsonValue one = JsonValue::object();
      one["x"] = half_x(2 * (symbol.x + plc::draw::symbol_begin(symbol.shape)));
      one["y"] = half_y(2 * symbol.y + 3);
      one["name"] = symbol.element->text;
      one["coil"] = symbol.element->kind == Element::Kind::Coil;
      switches.push_back(std::move(one));
    }
  }
  out["switches"] = std::move(switches);
  JsonValue values = JsonValue::array();
  for_each_output(picture, [&](const auto& /*source*/, double x, double y) { values.push_back(array_of({x, y})); });
  out["values"] = std::move(values);
  return out;
}

JsonValue chart_of(const plc::network::Chart& chart) {
  std::vector<plc::StepBox> boxes;
  const plc::draw::SvgPart part = plc::draw_chart(chart, &boxes);
  JsonValue out = JsonValue::object();
  out["svg"] = part.elements.elements();
  out["width"] = part.width;
  out["height"] = part.height;
  JsonValue steps = JsonValue::array();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const plc::StepBox& box = boxes[i];
    JsonValue one = JsonValue::object();
    one["name"] = chart.steps[i].name;
    one["box"] = array_of({double(box.x), double(box.y), double(box.width), double(box.height)});
    steps.push_back(std::move(one));
  }
  out["steps"] = std::move(steps);
  JsonValue conditions = JsonValue::array();
  for (const plc::network::Transition& each : chart.transitions) {
    conditions.push_back(plc::condition_text(*each.element));
  }
  out["conditions"] = std::move(conditions);
  return out;
}

std::string bits(const std::vector<bool>& flags) {
  std::string out;
  for (const bool flag : flags) {
    out += flag ? '1' : '0';
  }
  return out;
}

}  // namespace

JsonValue PlcView::networks_of(const Shown& shown) const {
  JsonValue networks = JsonValue::array();
  for (std::size_t i = 0; i < shown.body->pictures.size(); ++i) {
    const auto& drawn = shown.body->sheet->networks[i];
    JsonValue one = picture_of(shown.body->pictures[i]);
    one["number"] = drawn.number;
    one["remarks"] = JsonValue(plc::remarks_of(drawn));
    networks.push_back(std::move(one));
  }
  return networks;
}

JsonValue PlcView::pictures() const {
  JsonValue bodies = JsonValue::array();
  for (const Shown& shown : shown_) {
    JsonValue one = JsonValue::object();
    one["title"] = shown.title;
    one["action"] = shown.body->action;
    one["language"] = language_of(shown.body->body->language);
    if (shown.body->drawn()) {
      one["networks"] = networks_of(shown);
    } else if (shown.body->chart) {
      one["chart"] = chart_of(*shown.body->chart);
    } else if (is_text(*shown.body)) {
      JsonValue lines = JsonValue::array();
      for (const plc::LiveLine& line : plc::live_lines(first_indent(*shown.body) + shown.body->body->text,
                                                       [](const std::string&) { return std::string(); })) {
        lines.push_back(line.text);
      }
      one["lines"] = std::move(lines);
    }
    bodies.push_back(std::move(one));
  }
  JsonValue out = JsonValue::object();
  out["namespace"] = plan_.space;
  out["others"] = others_;
  out["bodies"] = std::move(bodies);
  return out;
}

void PlcView::add_networks(const Shown& shown, JsonValue& one) const {
  const plc::draw::Live live = live_of(shown);
  JsonValue networks = JsonValue::array();
  for (const plc::draw::Picture& picture : shown.body->pictures) {
    std::vector<bool> power;
    for (const plc::draw::Line& line : picture.lines) {
      power.push_back(std::any_of(line.sources.begin(), line.sources.end(), live.powered));
    }
    std::vector<bool> closed;
    for (const plc::draw::Symbol& symbol : picture.symbols) {
      if (is_switch(symbol)) {
        closed.push_back(live.closed(*symbol.element));
      }
    }
    JsonValue values = JsonValue::array();
    for_each_output(picture, [&](const plc::network::Source& source, double /*x*/, double /*y*/) {
      values.push_back(printable(live.value(source)));
    });
    JsonValue network = JsonValue::object();
    network["power"] = bits(power);
    network["closed"] = bits(closed);
    network["values"] = std::move(values);
    networks.push_back(std::move(network));
  }
  one["networks"] = std::move(networks);
}

void PlcView::add_steps(const Shown& shown, JsonValue& one) const {
  std::vector<bool> active;
  JsonValue times = JsonValue::array();
  for (const plc::network::Step& step : shown.body->chart->steps) {
    const std::string name = plc::upper(step.name);
    active.push_back(flag(shown, name, 0));
    times.push_back(active.back() ? value(shown, name + ".T") : std::string());
  }
  one["active"] = bits(active);
  one["times"] = std::move(times);
  JsonValue conditions = JsonValue::array();
  for (const plc::network::Transition& each : shown.body->chart->transitions) {
    const auto lines = plc::live_lines(plc::condition_text(*each.element),
                                       [&](const std::string& path) { return value(shown, path); });
    conditions.push_back(lines.empty() ? std::string() : printable(lines.front().values));
  }
  one["conditions"] = std::move(conditions);
}

JsonValue PlcView::live() const {
  JsonValue bodies = JsonValue::array();
  for (const Shown& shown : shown_) {
    JsonValue one = JsonValue::object();
    if (shown.body->drawn()) {
      add_networks(shown, one);
    } else if (shown.body->chart) {
      add_steps(shown, one);
    } else if (is_text(*shown.body)) {
      JsonValue values = JsonValue::array();
      for (const plc::LiveLine& line : plc::live_lines(first_indent(*shown.body) + shown.body->body->text,
                                                       [&](const std::string& path) { return value(shown, path); })) {
        values.push_back(printable(line.values));
      }
      one["values"] = std::move(values);
    }
    bodies.push_back(std::move(one));
  }
  JsonValue out = JsonValue::object();
  out["alive"] = source_->alive();
  out["bodies"] = std::move(bodies);
  return out;
}

}  // namespace indurop::tools
