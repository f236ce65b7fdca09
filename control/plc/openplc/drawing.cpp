// SPDX-License-Identifier: Apache-2.0
#include "control/plc/openplc/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace indurop::plc::openplc {
namespace {

using base::Json;
using network::Connection;
using network::Element;
using network::Pin;
using Kind = Element::Kind;

int number_of(const Json& value) {
  constexpr double kFar = 1e6;
  const double number = value.number().value_or(0);
  return std::abs(number) < kFar ? static_cast<int>(std::lround(number)) : 0;
}

std::optional<Kind> kind_of(const std::string& type, const std::string& variant) {
  static const std::map<std::string, Kind> kKinds{{"contact", Kind::Contact},
                                                  {"coil", Kind::Coil},
                                                  {"block", Kind::Block},
                                                  {"input-variable", Kind::InVariable},
                                                  {"output-variable", Kind::OutVariable},
                                                  {"inout-variable", Kind::InOutVariable},
                                                  {"connector", Kind::Connector},
                                                  {"continuation", Kind::Continuation},
                                                  {"comment", Kind::Comment}};
  if (type == "powerRail") {
    return variant == "left" ? std::optional(Kind::LeftRail) : std::nullopt;
  }
  if (type == "variable") {
    return variant == "output" ? Kind::OutVariable : Kind::InVariable;
  }
  const auto found = kKinds.find(type);
  return found != kKinds.end() ? std::optional(found->second) : std::nullopt;
}

bool has_input(Kind kind) noexcept {
  return kind == Kind::Contact || kind == Kind::Coil || kind == Kind::OutVariable || kind == Kind::InOutVariable ||
         kind == Kind::Connector;
}

// Reads one rung of a ladder, or a whole function block diagram.
class RungReader {
 public:
  RungReader(const Json& rung, Place at, std::uint64_t first_id, int top)
      : rung_(rung), at_(std::move(at)), next_id_(first_id), top_(top) {}

  void read(std::vector<Element>& out) {
    for (const Json& node : rung_["nodes"].values()) {
      nodes_[text_of(node["id"])] = &node;
      ids_[text_of(node["id"])] = next_id_++;
    }
    comment(out);
    for (const Json& node : rung_["nodes"].values()) {
      if (const auto kind = kind_of(text_of(node["type"]), text_of(node["data"]["variant"]))) {
        out.push_back(element(node, *kind));
      }
    }
  }
  [[nodiscard]] std::uint64_t next_id() const noexcept { return next_id_; }
  [[nodiscard]] int bottom() const noexcept { return bottom_; }

 private:
  void comment(std::vector<Element>& out) {
    Element made;
    made.kind = Kind::Comment;
    made.text = text_of(rung_["comment"]);
    made.id = next_id_++;
    made.at = at_;
    made.y = top_;
    if (!made.text.empty()) {
      out.push_back(std::move(made));
    }
  }

  Element element(const Json& node, Kind kind) {
    const Json& data = node["data"];
    Element made;
    made.kind = kind;
    made.id = ids_[text_of(node["id"])];
    made.at = at_;
    made.x = number_of(node["position"]["x"]);
    made.y = top_ + 1 + number_of(node["position"]["y"]);
    made.width = number_of(node["width"]);
    made.height = number_of(node["height"]);
    made.order = number_of(data["executionOrder"]);
    made.text = kind == Kind::Comment ? text_of(data["content"]) : text_of(data["variable"]["name"]);
    bottom_ = std::max(bottom_, made.y + made.height);
    if (kind == Kind::Block) {
      block(node, made);
      return made;
    }
    variant(text_of(data["variant"]), made);
    if (has_input(kind)) {
      made.inputs.push_back(input(node, {}));
    }
    return made;
  }

  static void variant(const std::string& text, Element& made) {
    made.negated = text == "negated";
    made.edge = text == "risingEdge" ? ast::Edge::Rising : text == "fallingEdge" ? ast::Edge::Falling : ast::Edge::None;
    made.storage = text == "set"     ? network::Storage::Set
                   : text == "reset" ? network::Storage::Reset
                                     : network::Storage::None;
  }

  void block(const Json& node, Element& made) {
    const Json& data = node["data"];
    made.type = text_of(data["variant"]["name"]);
    made.instance = text_of(data["variant"]["type"]) == "function" ? "" : made.text;
    made.text.clear();
    std::set<std::string> both;
    for (const Json& one : data["variant"]["variables"].values()) {
      if (text_of(one["class"]) == "inOut") {
        both.insert(text_of(one["name"]));
      }
    }
    for (const Json& handle : data["inputHandles"].values()) {
      const std::string name = text_of(handle["id"]);
      (both.contains(name) ? made.in_outs : made.inputs).push_back(input(node, name));
    }
    for (const Json& handle : data["outputHandles"].values()) {
      Pin pin;
      pin.at = at_;
      pin.name = text_of(handle["id"]);
      if (!both.contains(pin.name)) {
        made.outputs.push_back(std::move(pin));
      }
    }
  }

  // Reads an input; `handle` empty: its only one.
  Pin input(const Json& node, const std::string& handle) {
    Pin pin;
    pin.at = at_;
    pin.name = handle;
    std::set<std::string> seen;
    lead(text_of(node["id"]), handle, pin, seen);
    return pin;
  }

  // Follows branches of a ladder, which begin and end in special nodes that are only joints of lines.
  void lead(const std::string& to, const std::string& handle, Pin& pin, std::set<std::string>& seen) {
    for (const Json& edge : rung_["edges"].values()) {
      const bool here = text_of(edge["target"]) == to && (handle.empty() || text_of(edge["targetHandle"]) == handle);
      const std::string from = text_of(edge["source"]);
      const auto source = nodes_.find(from);
      if (!here || source == nodes_.end()) {
        continue;
      }
      const std::string type = text_of((*source->second)["type"]);
      if (type == "parallel") {
        if (seen.insert(from).second) {
          lead(from, "", pin, seen);
        }
        continue;
      }
      const std::uint64_t id = ids_[from];
      const std::string output = type == "block" ? text_of(edge["sourceHandle"]) : "";
      const bool known = std::any_of(pin.connections.begin(), pin.connections.end(),
                                     [&](const Connection& one) { return one.from == id && one.pin == output; });
      if (!known) {
        pin.connections.push_back({at_, id, output, {}});
      }
    }
  }

  const Json& rung_;
  Place at_;
  std::uint64_t next_id_;
  int top_;
  int bottom_ = 0;
  std::map<std::string, const Json*> nodes_;
  std::map<std::string, std::uint64_t> ids_;
};

}  // namespace

std::string text_of(const Json& value) {
  return value.text().value_or("");
}

network::Body read_drawing(const Json& flow, network::Body::Language language, const Place& at,
                           const std::string& pou) {
  constexpr int kGap = 60;
  network::Body out;
  out.language = language;
  out.at = at;
  Place inside = at;
  inside.within = std::make_shared<const std::string>("POU " + pou);
  std::uint64_t next_id = 1;
  int top = 0;
  const auto rung = [&](const Json& one) {
    RungReader reader(one, inside, next_id, top);
    reader.read(out.diagram.elements);
    next_id = reader.next_id();
    top = std::max(top, reader.bottom()) + kGap;
  };
  for (const Json& one : flow["rungs"].values()) {
    rung(one);
  }
  if (flow["rung"].is_object()) {
    rung(flow["rung"]);
  }
  return out;
}

}  // namespace indurop::plc::openplc
