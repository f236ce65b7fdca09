// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/placement.h"

#include <algorithm>
#include <unordered_map>

#include "control/plc/draw/picture.h"
#include "control/plc/model/diagnostics.h"
#include "control/plc/model/elementary.h"
#include "control/plc/network/chart.h"
#include "control/plc/network/sheet.h"
#include "control/plc/plcopen/sizes.h"
#include "control/plc/print/chart_layout.h"

namespace indurop::plc::plcopen {
namespace {

using network::Body;
using network::Connection;
using network::Element;
using network::Pin;
using network::Point;
using Kind = Element::Kind;
using Ids = std::vector<std::uint64_t>;

constexpr int kMargin = 20;
constexpr int kColumn = 200;  // of a chart
constexpr int kRow = 70;

bool has_places(const Body& body) {
  return std::any_of(body.diagram.elements.begin(), body.diagram.elements.end(),
                     [](const Element& one) { return one.x != 0 || one.y != 0; });
}

// The order in which the elements are evaluated, including transitions of a chart, and whether it is known.
struct Meaning {
  Ids order;
  std::size_t cuts = 0;
  bool known = false;
  friend bool operator==(const Meaning&, const Meaning&) = default;
};

Meaning meaning_of(Body body) {
  Meaning out;
  Diagnostics quiet;
  const network::Sheet sheet = network::make_sheet(body, "", quiet);
  for (const Element* one : sheet.order.elements) {
    out.order.push_back(one->id);
  }
  out.cuts = sheet.order.feedback.size();
  if (body.language == Body::Language::Sfc) {
    for (const network::Transition& one : network::read_chart(body.diagram, quiet).transitions) {
      out.order.push_back(one.element->id);
    }
  }
  out.known = !quiet.failed();
  return out;
}

// The places of elements by their ids; titles have none. Of equal ids the first one counts.
using ById = std::unordered_map<std::uint64_t, std::size_t>;

ById index_of(const std::vector<Element>& elements) {
  ById out;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].kind != Kind::Title) {
      out.emplace(elements[i].id, i);
    }
  }
  return out;
}

class Placer {
 public:
  explicit Placer(Body& body) : body_(body), by_id_(index_of(body.diagram.elements)) {}

  void networks() {
    Diagnostics quiet;
    const network::Sheet sheet = network::make_sheet(body_, "", quiet);
    if (quiet.failed()) {
      return;
    }
    const auto pictures = draw::lay_out(sheet, body_, quiet);
    if (quiet.failed()) {
      return;
    }
    std::size_t remark = 0;  // the next element above a network
    for (std::size_t n = 0; n < pictures.size(); ++n) {
      remarks(remark, sheet.networks[n].elements);
      const int top = y_;
      for (const draw::Symbol& symbol : pictures[n].symbols) {
        if (symbol.element != nullptr) {
          put(find(symbol.element->id), symbol, top);
        }
      }
      y_ = top + kLine * (pictures[n].height + 1);
      right_ = std::max(right_, kMargin + kCharacter * pictures[n].width);
    }
    remarks(remark, {});
    rails();
  }

  void chart() {
    Diagnostics quiet;
    const network::Chart chart = network::read_chart(body_.diagram, quiet);
    if (quiet.failed()) {
      return;
    }
    const ChartLayout spots = lay_out_chart(chart);
    const auto stand = [&](const Element* element, const ChartSpot& spot) {
      Element& at = find(element->id);
      at.x = kMargin + kColumn * static_cast<int>(spot.column) + kColumn / 2 - at.width / 2;
      at.y = kMargin + kRow * static_cast<int>(spot.row);
    };
    for (std::size_t i = 0; i < chart.steps.size(); ++i) {
      stand(chart.steps[i].element, spots.steps[i]);
    }
    for (std::size_t i = 0; i < chart.transitions.size(); ++i) {
      stand(chart.transitions[i].element, spots.transitions[i]);
    }
    others();
    // Transitions are ordered from left to right; where they were not, their priorities define it.
    if (const Body copy = body_;
        network::read_chart(copy.diagram, quiet).transitions.size() == chart.transitions.size()) {
      rank(chart, network::read_chart(copy.diagram, quiet));
    }
  }

 private:
  [[nodiscard]] Element& find(std::uint64_t id) { return body_.diagram.elements[by_id_.at(id)]; }

  static bool is_remark(const Element& element) {
    return element.kind == Kind::Label || element.kind == Kind::Comment || element.kind == Kind::Title;
  }

  // Places elements that come before the first one of the network in the file.
  void remarks(std::size_t& next, const std::vector<const Element*>& network) {
    auto& elements = body_.diagram.elements;
    for (; next < elements.size(); ++next) {
      const Element& one = elements[next];
      if (std::any_of(network.begin(), network.end(), [&](const Element* each) { return each == &one; })) {
        return;
      }
      if (is_remark(one)) {
        elements[next].x = kMargin;
        elements[next].y = y_;
        y_ += one.height + kLine;
      }
    }
  }

  static void put(Element& element, const draw::Symbol& symbol, int top) {
    element.x = kMargin + kCharacter * symbol.x;
    element.y = top + kLine * symbol.y;
    if (element.kind == Kind::Contact || element.kind == Kind::Coil) {
      element.x += kCharacter * symbol.shape.width / 2 - element.width / 2;
      element.y += kLine + (kLine - element.height) / 2;
    } else if (element.kind == Kind::Block) {
      element.width = kCharacter * symbol.shape.width;
    }
  }

  void rails() {
    for (Element& one : body_.diagram.elements) {
      if (one.kind == Kind::LeftRail || one.kind == Kind::RightRail) {
        one.x = one.kind == Kind::LeftRail ? kMargin : right_;
        one.y = kMargin;
        one.height = std::max(y_ - kMargin, one.height);
      }
    }
  }

  // Places beams of a chart at the elements that lead to them, jumps and action blocks next to these, conditions left
  // of them.
  void others() {
    for (Element& one : body_.diagram.elements) {
      const bool known = one.kind == Kind::Step || one.kind == Kind::Transition;
      const Connection* line = !one.inputs.empty() && !one.inputs.front().connections.empty()
                                   ? &one.inputs.front().connections.front()
                                   : nullptr;
      if (known || line == nullptr) {
        continue;
      }
      const auto found = by_id_.find(line->from);
      const Element* from = found == by_id_.end() ? nullptr : &body_.diagram.elements[found->second];
      if (from == nullptr || from == &one) {
        continue;
      }
      const bool to_the_right = one.kind == Kind::ActionBlock;
      one.x = to_the_right ? from->x + from->width + kMargin : from->x + from->width / 2 - one.width / 2;
      one.y = to_the_right ? from->y : from->y + from->height + kMargin;
    }
  }

  void rank(const network::Chart& wanted, const network::Chart& drawn) {
    bool same = true;
    for (std::size_t i = 0; i < wanted.transitions.size(); ++i) {
      same = same && wanted.transitions[i].element->id == drawn.transitions[i].element->id;
    }
    for (std::size_t i = 0; i < wanted.transitions.size() && !same; ++i) {
      find(wanted.transitions[i].element->id).priority = static_cast<int>(i) + 1;
    }
  }

  Body& body_;
  ById by_id_;
  int y_ = kMargin;
  int right_ = 0;
};

// Completes sizes, spots and corners.
class Finisher {
 public:
  explicit Finisher(std::vector<Element>& elements) : elements_(elements), by_id_(index_of(elements)) {}

  void run() {
    each_line([this](Pin&, Connection& line) { ++lines_[line.from]; });
    for (Element& one : elements_) {
      const bool several = one.kind == Kind::LeftRail || one.kind == Kind::SelectionDivergence ||
                           one.kind == Kind::SimultaneousDivergence;
      give_spots(one, several ? std::max<std::size_t>(lines_[one.id], 1) : 1);
    }
    for (Element& one : elements_) {
      for (auto* pins : {&one.inputs, &one.in_outs}) {
        for (Pin& pin : *pins) {
          corners(one, pin);
        }
      }
      if (one.condition) {
        corners(one, *one.condition);
      }
    }
  }

 private:
  template <class Visit>
  void each_line(Visit visit) {
    for (Element& one : elements_) {
      for (auto* pins : {&one.inputs, &one.in_outs}) {
        for (Pin& pin : *pins) {
          for (Connection& line : pin.connections) {
            visit(pin, line);
          }
        }
      }
    }
  }

  void corners(const Element& element, Pin& pin) {
    const Point to{element.x + pin.spot->x, element.y + pin.spot->y};
    for (Connection& line : pin.connections) {
      const auto found = by_id_.find(line.from);
      if (!line.corners.empty() || found == by_id_.end()) {
        continue;
      }
      const Element& source = elements_[found->second];
      const Point out = spot_of(source, line);
      const Point from{source.x + out.x, source.y + out.y};
      const int x = (from.x + to.x) / 2;
      const int y = (from.y + to.y) / 2;
      line.corners.push_back(to);
      if (is_upright(element.kind) && from.x != to.x) {
        line.corners.insert(line.corners.end(), {{to.x, y}, {from.x, y}});
      } else if (!is_upright(element.kind) && from.y != to.y) {
        line.corners.insert(line.corners.end(), {{x, to.y}, {x, from.y}});
      }
      line.corners.push_back(from);
    }
  }

  // Lines of one element with several ends use them one after the other.
  Point spot_of(const Element& source, const Connection& line) {
    for (const auto* pins : {&source.outputs, &source.in_outs}) {
      for (const Pin& pin : *pins) {
        if (source.kind == Kind::Block && (line.pin.empty() || same_name(pin.name, line.pin)) && pin.spot) {
          return {source.width, pin.spot->y};
        }
      }
    }
    const std::size_t next = taken_[source.id]++;
    return source.ends.empty() ? Point{source.width, source.height / 2} : source.ends[next % source.ends.size()];
  }

  std::vector<Element>& elements_;
  ById by_id_;
  std::unordered_map<std::uint64_t, std::size_t> lines_;
  std::unordered_map<std::uint64_t, std::size_t> taken_;
};

}  // namespace

void place(Body& body) {
  for (Element& one : body.diagram.elements) {
    give_size(one);
  }
  if (!has_places(body)) {
    Body placed = body;
    Placer placer(placed);
    if (body.language == Body::Language::Sfc) {
      placer.chart();
    } else {
      placer.networks();
    }
    const Meaning before = meaning_of(body);
    if (before.known && meaning_of(placed) == before) {
      body = std::move(placed);
    }
  }
  Finisher(body.diagram.elements).run();
}

}  // namespace indurop::plc::plcopen
