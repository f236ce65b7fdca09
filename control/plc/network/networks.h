// SPDX-License-Identifier: Apache-2.0
// Splits a ladder or function block diagram into networks (rungs): groups of connected elements, from top to bottom,
// numbered from 1.

#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "control/plc/network/diagram.h"

namespace indurop::plc::network {

// An output of an element.
struct Source {
  const Element* element = nullptr;
  const Pin* pin = nullptr;  // of blocks
};
[[nodiscard]] bool operator==(const Source& a, const Source& b) noexcept;

// Finds elements by their ids, and the sources of connections.
class Index {
 public:
  explicit Index(const Diagram& diagram);

  [[nodiscard]] const Element* find(std::uint64_t id) const noexcept;
  // Returns the source of a connection. For a block without the name of an output: its first one other than ENO.
  // element is null if there is no such element, pin is null if the block has no such output.
  [[nodiscard]] Source source(const Connection& connection) const noexcept;
  // Returns the connector that a continuation continues, or null.
  [[nodiscard]] const Element* connector(const std::string& name) const noexcept;
  [[nodiscard]] const std::vector<const Element*>& right_rails() const noexcept { return right_rails_; }

 private:
  std::vector<const Element*> right_rails_;
  std::unordered_map<std::uint64_t, const Element*> elements_;
  std::unordered_map<std::string, const Element*> connectors_;
};

struct Network {
  int number = 0;
  std::string title;
  std::vector<std::string> labels;       // before it
  std::vector<std::string> comments;     // above it and next to it
  std::vector<const Element*> elements;  // in file order, without power rails
};

// Splits the diagram; elements of charts are left out. Afterwards the places of all elements name their network: "POU
// main, rung 3, contact Start" (`word` is rung or network).
[[nodiscard]] std::vector<Network> split_networks(Diagram& diagram, const std::string& what, const char* word);

}  // namespace indurop::plc::network
