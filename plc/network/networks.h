// SPDX-License-Identifier: Apache-2.0
// The networks (rungs) of a ladder or function block diagram: what is connected, from top to bottom, numbered from 1.

#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "plc/network/diagram.h"

namespace indurop::plc::network {

// An output of an element.
struct Source {
  const Element* element = nullptr;
  const Pin* pin = nullptr;  // of blocks
};
[[nodiscard]] bool operator==(const Source& a, const Source& b) noexcept;

// Elements by their ids, and what connections mean.
class Index {
 public:
  explicit Index(const Diagram& diagram);

  [[nodiscard]] const Element* find(std::uint64_t id) const noexcept;
  // Where a connection comes from. Of a block without the name of an output: its first one that is not ENO.
  // element is null if there is no such element, pin is null if the block has no such output.
  [[nodiscard]] Source source(const Connection& connection) const noexcept;
  // The connector a continuation goes on from, or null.
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
  std::vector<std::string> comments;     // above it and beside it
  std::vector<const Element*> elements;  // in the order of the file, power rails left out
};

// Elements of charts are left out. The places of all elements name their network from then on: "POU main, rung 3,
// contact Start" (`word` is rung or network).
[[nodiscard]] std::vector<Network> split_networks(Diagram& diagram, const std::string& what, const char* word);

}  // namespace indurop::plc::network
