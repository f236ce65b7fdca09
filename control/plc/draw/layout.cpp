// SPDX-License-Identifier: Apache-2.0
// Turns items in columns and lines into a picture: widths of columns, tracks between them, pieces of lines.
#include <fmt/format.h>

#include <algorithm>

#include "control/plc/draw/layout_graph.h"
#include "control/plc/draw/picture.h"
#include "control/plc/draw/rows.h"

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;
using Role = Item::Role;

constexpr int kTrackPitch = 2;
constexpr std::int64_t kMostCharacters = 4'000'000;  // of the pictures of one body

int middle(int cell) noexcept {
  return 2 * cell + 1;
}

class Painter {
 public:
  Painter(Graph graph, bool rails, int width)
      : graph_(std::move(graph)), nets_(nets_by_column(graph_)), rails_(rails), width_(width) {}

  Picture run() {
    picture_.rails = rails_;
    assign_rows(graph_);
    place_columns();
    place_symbols();
    std::vector<std::vector<const Item*>> wires(nets_.size());
    for (const Item& each : graph_.items) {
      if (each.role == Role::Wire && each.symbol.shape.width > 0) {
        wires[static_cast<std::size_t>(each.column)].push_back(&each);
      }
    }
    for (std::size_t column = 0; column + 1 < nets_.size(); ++column) {
      lines_behind(column, wires[column]);
    }
    for (Item& item : graph_.items) {
      picture_.height = std::max(picture_.height, item.symbol.y + item.symbol.shape.height);
      if (item.role == Role::Symbol) {
        picture_.symbols.push_back(std::move(item.symbol));
      }
    }
    return std::move(picture_);
  }

 private:
  static Kind kind_of(const Item& each) {
    return each.symbol.element == nullptr ? Kind::InVariable : each.symbol.element->kind;
  }
  Item& item(const End& end) { return graph_.items[static_cast<std::size_t>(end.item)]; }

  void place_columns() {
    const auto count = static_cast<std::size_t>(graph_.columns);
    widths_.assign(count, 0);
    for (const Item& each : graph_.items) {
      int& width = widths_[static_cast<std::size_t>(each.column)];
      width = std::max(width, each.role == Role::Symbol ? each.symbol.shape.width : 0);
    }
    int x = rails_ ? 1 : 0;
    for (int column = 0; column < graph_.columns; ++column) {
      begins_.push_back(x);
      int clash = -1;
      tracks_.push_back(assign_tracks(graph_, nets_[static_cast<std::size_t>(column)], clash));
      const auto& tracks = tracks_.back();
      const int used = tracks.empty() ? 0 : *std::max_element(tracks.begin(), tracks.end()) + 1;
      const bool last = column + 1 == graph_.columns;
      x += widths_[static_cast<std::size_t>(column)] + (last ? 0 : 2 + kTrackPitch * used);
    }
    x += rails_ ? 1 : 0;
    if (rails_ && x < width_) {
      widen(width_ - x);
      x = width_;
    }
    picture_.width = x;
  }

  // Moves the rail to the right, and the coils with it.
  void widen(int by) {
    int last = graph_.columns;
    for (const Item& each : graph_.items) {
      const Kind kind = kind_of(each);
      const bool end = kind == Kind::Coil || kind == Kind::Jump || kind == Kind::Return;
      last = each.role == Role::RightRail || (end && each.column + 2 >= graph_.columns) ? std::min(last, each.column)
                                                                                        : last;
    }
    for (int column = last; column < graph_.columns; ++column) {
      begins_[static_cast<std::size_t>(column)] += by;
    }
  }

  void place_symbols() {
    for (Item& each : graph_.items) {
      Symbol& symbol = each.symbol;
      const auto column = static_cast<std::size_t>(each.column);
      const int room = widths_[column] - symbol.shape.width;
      const Kind kind = kind_of(each);
      symbol.x = begins_[column];
      if (each.role != Role::Symbol) {
        symbol.shape.width = widths_[column];
      } else if (kind == Kind::Contact || kind == Kind::Coil) {
        symbol.x += room / 2;
      } else if (symbol.shape.inputs.empty() && kind != Kind::Block) {
        symbol.x += room;
      }
    }
  }

  // Returns where a line meets the item, in halves of characters: the border of a block, the symbol of a contact.
  [[nodiscard]] int left_end(const Item& each) const {
    const int begin = 2 * each.symbol.x;
    switch (kind_of(each)) {
      case Kind::Block:
        return begin + 1;
      case Kind::Contact:
      case Kind::Coil:
        return begin + 2 * symbol_begin(each.symbol.shape);
      default:
        return each.role == Role::RightRail ? middle(picture_.width - 1) : begin;
    }
  }
  [[nodiscard]] int right_end(const Item& each) const {
    const int end = 2 * (each.symbol.x + each.symbol.shape.width);
    switch (kind_of(each)) {
      case Kind::Block:
        return end - 1;
      case Kind::Contact:
      case Kind::Coil:
        return 2 * (each.symbol.x + symbol_begin(each.symbol.shape) + kSymbolWidth);
      default:
        return each.role == Role::LeftRail ? middle(0) : end;
    }
  }

  // `wires`: those of the column.
  void lines_behind(std::size_t column, const std::vector<const Item*>& wires) {
    const int first_track = begins_[column] + widths_[column] + 1;
    const std::vector<int>& tracks = tracks_[column];
    for (std::size_t i = 0; i < nets_[column].size(); ++i) {
      const std::size_t n = nets_[column][i];
      const int track = tracks.empty() ? -1 : tracks[i];
      draw(graph_.nets[n], static_cast<int>(n), track < 0 ? -1 : middle(first_track + kTrackPitch * track));
    }
    for (const Item* each : wires) {
      const int y = middle(each->symbol.y);
      const int begin = each->symbol.x;
      picture_.lines.push_back({2 * begin, y, 2 * (begin + each->symbol.shape.width), y, -1, each->carries});
    }
  }

  void draw(const Net& net, int number, int track) {
    if (track < 0) {
      const End& from = net.sources.front();
      const int y = middle(output_row(graph_, from));
      picture_.lines.push_back({right_end(item(from)), y, left_end(item(net.targets.front())), y, number, net.carries});
      return;
    }
    int top = middle(output_row(graph_, net.sources.front()));
    int bottom = top;
    for (const End& end : net.sources) {
      const int y = middle(output_row(graph_, end));
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      picture_.lines.push_back({right_end(item(end)), y, track, y, number, end.carries});
    }
    for (const End& end : net.targets) {
      const int y = middle(input_row(graph_, end));
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      picture_.lines.push_back({track, y, left_end(item(end)), y, number, net.carries});
    }
    picture_.lines.push_back({track, top, track, bottom, number, net.carries});
  }

  Graph graph_;
  std::vector<std::vector<std::size_t>> nets_;  // by column
  bool rails_;
  int width_;  // minimum
  Picture picture_;
  std::vector<int> begins_;  // first character of each column
  std::vector<int> widths_;
  std::vector<std::vector<int>> tracks_;  // after each column, by its nets
};

}  // namespace

std::vector<Picture> lay_out(const Sheet& sheet, const Body& body, Diagnostics& diagnostics) {
  const bool ladder = body.language == Body::Language::Ld;
  const auto refuse = [&](const Place& at, const std::string& what) {
    diagnostics.error(at, "too large for a picture: " + what);
    return std::vector<Picture>{};
  };
  int width = 0;
  std::vector<Picture> pictures;
  for (const Network& network : sheet.networks) {
    Graph graph = make_graph(network, sheet.index, sheet.order, ladder);
    if (graph.too_large) {
      return refuse(network.elements.front()->at,
                    "the lines of its network pass too many columns; replace long lines by variables");
    }
    pictures.push_back(Painter(std::move(graph), ladder, 0).run());
    width = std::max(width, pictures.back().width);
  }
  std::int64_t characters = 0;
  for (const Picture& each : pictures) {
    characters += std::int64_t{ladder ? width : each.width} * each.height;
  }
  if (characters > kMostCharacters) {
    return refuse(
        body.at, fmt::format("it has more than {} characters; split it into several POUs or actions", kMostCharacters));
  }
  for (std::size_t i = 0; ladder && i < pictures.size(); ++i) {
    if (pictures[i].width < width) {
      pictures[i] = Painter(make_graph(sheet.networks[i], sheet.index, sheet.order, true), true, width).run();
    }
  }
  return pictures;
}

}  // namespace indurop::plc::draw
