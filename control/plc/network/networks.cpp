// SPDX-License-Identifier: Apache-2.0
#include "control/plc/network/networks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "control/plc/model/elementary.h"

namespace indurop::plc::network {
namespace {

using Kind = Element::Kind;

bool is_rail(const Element& element) noexcept {
  return element.kind == Kind::LeftRail || element.kind == Kind::RightRail;
}
// Returns true for elements next to networks that belong to the next one.
bool is_remark(const Element& element) noexcept {
  return element.kind == Kind::Comment || element.kind == Kind::Title || element.kind == Kind::Label;
}
bool is_chart(const Element& element) noexcept {
  return element.kind >= Kind::Step;
}

// Sets of elements that are connected.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

template <class Function>
void each_connection(const Element& element, Function&& function) {
  for (const auto* pins : {&element.inputs, &element.in_outs}) {
    for (const Pin& pin : *pins) {
      for (const Connection& connection : pin.connections) {
        function(connection);
      }
    }
  }
}

// A network before it is numbered: its extent on the sheet, and its begin in the file.
struct Draft {
  Network network;
  int top = std::numeric_limits<int>::max();
  int left = std::numeric_limits<int>::max();
  int bottom = std::numeric_limits<int>::min();
  std::size_t first = std::numeric_limits<std::size_t>::max();
};

bool has_places(const std::vector<Element>& elements) {
  return std::any_of(elements.begin(), elements.end(), [](const Element& e) { return e.x != 0 || e.y != 0; });
}

class Splitter {
 public:
  explicit Splitter(const Diagram& diagram)
      : elements_(diagram.elements), index_(diagram), groups_(elements_.size()), drawn_(has_places(elements_)) {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      positions_.emplace(&elements_[i], i);
    }
  }

  std::vector<Network> run() {
    join();
    collect();
    std::sort(drafts_.begin(), drafts_.end(), [&](const Draft& a, const Draft& b) {
      return drawn_ ? std::tie(a.top, a.left, a.first) < std::tie(b.top, b.left, b.first) : a.first < b.first;
    });
    attach_remarks();
    std::vector<Network> networks;
    for (Draft& draft : drafts_) {
      draft.network.number = static_cast<int>(networks.size()) + 1;
      networks.push_back(std::move(draft.network));
    }
    return networks;
  }

 private:
  void join() {
    for (const Element& element : elements_) {
      if (is_rail(element) || is_chart(element)) {
        continue;
      }
      each_connection(element, [&](const Connection& connection) {
        const Element* from = index_.find(connection.from);
        if (from != nullptr && !is_rail(*from) && !is_chart(*from)) {
          groups_.join(positions_.at(&element), positions_.at(from));
        }
      });
      const Element* connector = element.kind == Kind::Continuation ? index_.connector(element.text) : nullptr;
      if (connector != nullptr) {
        groups_.join(positions_.at(&element), positions_.at(connector));
      }
    }
  }

  void collect() {
    std::unordered_map<std::size_t, std::size_t> made;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const Element& element = elements_[i];
      if (is_rail(element) || is_chart(element) || is_remark(element)) {
        continue;
      }
      const auto [at, fresh] = made.try_emplace(groups_.find(i), drafts_.size());
      if (fresh) {
        drafts_.emplace_back();
      }
      Draft& draft = drafts_[at->second];
      draft.network.elements.push_back(&element);
      draft.top = std::min(draft.top, element.y);
      draft.left = std::min(draft.left, element.x);
      draft.bottom = std::max(draft.bottom, element.y + element.height);
      draft.first = std::min(draft.first, i);
    }
  }

  void attach_remarks() {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const Element& element = elements_[i];
      if (!is_remark(element)) {
        continue;
      }
      auto draft = std::find_if(drafts_.begin(), drafts_.end(),
                                [&](const Draft& each) { return drawn_ ? each.bottom >= element.y : each.first > i; });
      if (draft == drafts_.end() && (element.kind == Kind::Label || drafts_.empty())) {
        draft = drafts_.emplace(drafts_.end());  // a label after the last network: the end of the body
        draft->bottom = std::numeric_limits<int>::max();
      }
      attach(element, draft == drafts_.end() ? drafts_.back() : *draft);
    }
  }

  static void attach(const Element& element, Draft& draft) {
    if (element.kind == Kind::Label) {
      draft.network.labels.push_back(element.text);
    } else if (element.kind == Kind::Title) {
      draft.network.title = element.text;
    } else if (!element.text.empty()) {
      draft.network.comments.push_back(element.text);
    }
  }

  const std::vector<Element>& elements_;
  Index index_;
  Groups groups_;
  bool drawn_ = false;  // elements have places on the sheet
  std::unordered_map<const Element*, std::size_t> positions_;
  std::vector<Draft> drafts_;
};

void name_places(Element& element, const std::string& network) {
  const auto name = std::make_shared<const std::string>(network + ", " + title_of(element));
  element.at.within = name;
  for (auto* pins : {&element.inputs, &element.in_outs, &element.outputs}) {
    for (Pin& pin : *pins) {
      pin.at.within =
          pin.name.empty() ? name : std::make_shared<const std::string>(fmt::format("{}, pin {}", *name, pin.name));
      for (Connection& connection : pin.connections) {
        connection.at.within = pin.at.within;
      }
    }
  }
}

}  // namespace

bool operator==(const Source& a, const Source& b) noexcept {
  return a.element == b.element && a.pin == b.pin;
}

Index::Index(const Diagram& diagram) {
  for (const Element& element : diagram.elements) {
    if (element.kind != Element::Kind::Title) {  // they have no id
      elements_.emplace(element.id, &element);
    }
    if (element.kind == Kind::Connector) {
      connectors_.emplace(upper(element.text), &element);
    }
  }
}

const Element* Index::find(std::uint64_t id) const noexcept {
  const auto found = elements_.find(id);
  return found == elements_.end() ? nullptr : found->second;
}

const Element* Index::connector(const std::string& name) const noexcept {
  const auto found = connectors_.find(upper(name));
  return found == connectors_.end() ? nullptr : found->second;
}

Source Index::source(const Connection& connection) const noexcept {
  const Element* element = find(connection.from);
  if (element == nullptr || element->kind != Kind::Block) {
    return {element, nullptr};
  }
  for (const auto* pins : {&element->outputs, &element->in_outs}) {
    for (const Pin& pin : *pins) {
      if (connection.pin.empty() ? !same_name(pin.name, "ENO") : same_name(pin.name, connection.pin)) {
        return {element, &pin};
      }
    }
  }
  return {element, nullptr};
}

std::vector<Network> split_networks(Diagram& diagram, const std::string& what, const char* word) {
  std::vector<Network> networks = Splitter(diagram).run();
  std::unordered_map<const Element*, int> numbers;
  for (const Network& network : networks) {
    for (const Element* element : network.elements) {
      numbers.emplace(element, network.number);
    }
  }
  for (Element& element : diagram.elements) {
    const auto number = numbers.find(&element);
    name_places(element, number == numbers.end() ? what : fmt::format("{}, {} {}", what, word, number->second));
  }
  return networks;
}

}  // namespace indurop::plc::network
