// SPDX-License-Identifier: Apache-2.0
// What the layout works on: symbols and pieces of wire as items in columns, joined by nets.

#pragma once

#include <vector>

#include "plc/draw/picture.h"

namespace indurop::plc::draw {

struct Item {
  enum class Role : std::uint8_t { Symbol, Wire, LeftRail, RightRail };
  Role role = Role::Symbol;
  Symbol symbol;    // of others than symbols: one line high
  double rank = 0;  // order in its column
  int column = 0;
  std::vector<Source> carries;  // what flows out of others than symbols
};

struct End {
  int item = 0;
  int port = 0;                 // index of an input or output
  std::vector<Source> carries;  // what flows out of a source
};

// Everything that comes out of `sources` goes into all `targets`.
struct Net {
  std::vector<End> sources;
  std::vector<End> targets;
  std::vector<Source> carries;
};

struct Graph {
  std::vector<Item> items;
  std::vector<Net> nets;
  int columns = 0;
};

// What follows an item stands as high as it, but what follows its pins one below the other.
inline constexpr double kBehind = 1e-6;
inline constexpr double kPinRank = 1e-4;

// Symbols and nets of a network, each source in one net only, columns assigned; every net leads from one column to the
// next.
[[nodiscard]] Graph make_graph(const Network& network, const Index& index, const Order& order, bool rails);

}  // namespace indurop::plc::draw
