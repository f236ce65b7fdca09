// SPDX-License-Identifier: Apache-2.0
// The data of the layout: symbols and pieces of wire as items in columns, joined by nets.

#pragma once

#include <vector>

#include "control/plc/draw/picture.h"

namespace indurop::plc::draw {

struct Item {
  enum class Role : std::uint8_t { Symbol, Wire, LeftRail, RightRail };
  Role role = Role::Symbol;
  Symbol symbol;    // other items than symbols are one line high
  double rank = 0;  // order in its column
  int column = 0;
  std::vector<Source> carries;  // sources that leave an item other than a symbol
};

struct End {
  int item = 0;
  int port = 0;                 // index of an input or output
  std::vector<Source> carries;  // sources that flow out here
};

// All `sources` flow into all `targets`.
struct Net {
  std::vector<End> sources;
  std::vector<End> targets;
  std::vector<Source> carries;
};

struct Graph {
  std::vector<Item> items;
  std::vector<Net> nets;
  int columns = 0;
  bool too_large = false;  // no columns are assigned: more than kMostWires pieces of wire
};

inline constexpr std::size_t kMostWires = 50'000;

// The successor of an item is at its height; successors of its pins are ordered one below the other.
inline constexpr double kBehind = 1e-6;
inline constexpr double kPinRank = 1e-4;

// Returns symbols and nets of a network, each source in one net only, with columns assigned, if there are not too
// many; every net leads from one column to the next.
[[nodiscard]] Graph make_graph(const Network& network, const Index& index, const Order& order, bool rails);

}  // namespace indurop::plc::draw
