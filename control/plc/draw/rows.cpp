// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/rows.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace indurop::plc::draw {
namespace {

// Further rounds only move items apart that cannot all be straight.
constexpr int kRounds = 4;
constexpr int kMostClashes = 200;

const Item& item_of(const Graph& graph, const End& end) {
  return graph.items[static_cast<std::size_t>(end.item)];
}

class Rows {
 public:
  explicit Rows(Graph& graph) : graph_(graph), nets_(nets_by_column(graph)) {
    columns_.resize(static_cast<std::size_t>(graph.columns));
    for (std::size_t i = 0; i < graph.items.size(); ++i) {
      columns_[static_cast<std::size_t>(graph.items[i].column)].push_back(i);
    }
    for (auto& column : columns_) {
      std::stable_sort(column.begin(), column.end(),
                       [&](std::size_t a, std::size_t b) { return graph.items[a].rank < graph.items[b].rank; });
    }
    const auto higher = [&](const End& a, const End& b) { return item_of(graph, a).rank < item_of(graph, b).rank; };
    for (Net& net : graph.nets) {
      std::stable_sort(net.sources.begin(), net.sources.end(), higher);
      std::stable_sort(net.targets.begin(), net.targets.end(), higher);
    }
    into_.assign(graph.items.size(), nullptr);
    out_of_.assign(graph.items.size(), nullptr);
    for (const Net& net : graph.nets) {
      for (const End& end : net.targets) {
        const auto i = static_cast<std::size_t>(end.item);
        into_[i] = into_[i] == nullptr || end.port < port_into(i) ? &net : into_[i];
      }
      const auto first = static_cast<std::size_t>(net.sources.front().item);
      out_of_[first] = out_of_[first] == nullptr ? &net : out_of_[first];
    }
  }

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      for (const auto& column : columns_) {
        stack(column, true);
      }
      for (auto column = columns_.rbegin(); column != columns_.rend(); ++column) {
        pull_down(*column);
      }
    }
    settle();
    int top = std::numeric_limits<int>::max();
    for (const Item& item : graph_.items) {
      top = std::min(top, item.symbol.y);
    }
    for (Item& item : graph_.items) {
      item.symbol.y -= top;
    }
    for (int i = 0; i < kMostClashes; ++i) {
      const int clash = find_clash();
      if (clash < 0) {
        return;
      }
      ++graph_.items[static_cast<std::size_t>(clash)].symbol.y;
      settle();
    }
  }

 private:
  [[nodiscard]] int port_into(std::size_t i) const {
    int port = std::numeric_limits<int>::max();
    for (const End& end : into_[i]->targets) {
      port = static_cast<std::size_t>(end.item) == i ? std::min(port, end.port) : port;
    }
    return port;
  }

  void stack(const std::vector<std::size_t>& column, bool straight) {
    int free = 0;
    for (const std::size_t i : column) {
      Symbol& symbol = graph_.items[i].symbol;
      symbol.y = std::max(symbol.y, free);
      if (straight && into_[i] != nullptr) {
        const int port = symbol.shape.inputs[static_cast<std::size_t>(port_into(i))];
        symbol.y = std::max(symbol.y, output_row(graph_, into_[i]->sources.front()) - port);
      }
      free = symbol.y + symbol.shape.height;
    }
  }

  // Aligns the first of the sources of a net with the first of its targets.
  void pull_down(const std::vector<std::size_t>& column) {
    for (const std::size_t i : column) {
      if (out_of_[i] != nullptr) {
        Symbol& symbol = graph_.items[i].symbol;
        const int own = output_row(graph_, out_of_[i]->sources.front()) - symbol.y;
        symbol.y = std::max(symbol.y, input_row(graph_, out_of_[i]->targets.front()) - own);
      }
    }
    stack(column, false);
  }

  void settle() {
    for (const auto& column : columns_) {
      stack(column, false);
    }
  }

  [[nodiscard]] int find_clash() const {
    int clash = -1;
    for (std::size_t column = 0; column + 1 < nets_.size() && clash < 0; ++column) {
      (void)assign_tracks(graph_, nets_[column], clash);
    }
    return clash;
  }

  Graph& graph_;
  std::vector<std::vector<std::size_t>> nets_;  // by column
  std::vector<std::vector<std::size_t>> columns_;
  std::vector<const Net*> into_;    // by item: the net into its first connected input
  std::vector<const Net*> out_of_;  // by item: the net of which it is the first source
};

// The lines that a net between two columns touches.
struct Span {
  std::size_t net = 0;  // index in the nets of its column
  int top = 0;
  int bottom = 0;
  std::vector<int> left;   // lines of its sources
  std::vector<int> right;  // lines of its targets
};

std::vector<Span> spans_of(const Graph& graph, const std::vector<std::size_t>& nets) {
  std::vector<Span> spans;
  for (std::size_t n = 0; n < nets.size(); ++n) {
    const Net& net = graph.nets[nets[n]];
    Span span;
    span.net = n;
    for (const End& end : net.sources) {
      span.left.push_back(output_row(graph, end));
    }
    for (const End& end : net.targets) {
      span.right.push_back(input_row(graph, end));
    }
    span.top = std::min(*std::min_element(span.left.begin(), span.left.end()),
                        *std::min_element(span.right.begin(), span.right.end()));
    span.bottom = std::max(*std::max_element(span.left.begin(), span.left.end()),
                           *std::max_element(span.right.begin(), span.right.end()));
    spans.push_back(std::move(span));
  }
  return spans;
}

// Sorts spans so that the track of each can be right of those before it. A span with a source in a line comes before
// the one with a target in it; else the order stays. Returns those sorted before the first circle.
std::vector<const Span*> in_order(const std::vector<Span>& spans) {
  std::unordered_map<int, std::size_t> from;  // by line
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (const int row : spans[i].left) {
      from.emplace(row, i);
    }
  }
  std::vector<std::size_t> waits(spans.size(), 0);
  std::vector<std::vector<std::size_t>> before(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    for (const int row : spans[i].right) {
      if (const auto found = from.find(row); found != from.end() && found->second != i) {
        before[found->second].push_back(i);
        ++waits[i];
      }
    }
  }
  std::set<std::size_t> ready;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (waits[i] == 0) {
      ready.insert(i);
    }
  }
  std::vector<const Span*> order;
  while (!ready.empty()) {
    const std::size_t next = *ready.begin();
    ready.erase(ready.begin());
    order.push_back(&spans[next]);
    for (const std::size_t each : before[next]) {
      if (--waits[each] == 0) {
        ready.insert(each);
      }
    }
  }
  return order;
}

// The rightmost track that is taken in each line.
class Skyline {
 public:
  // Returns the first track right of all that are taken in these lines, and takes it.
  int take(int top, int bottom) {
    const auto begin = from(top);
    const auto end = from(bottom + 1);
    int track = 0;
    for (auto each = begin; each != end; ++each) {
      track = std::max(track, each->second + 1);
    }
    begin->second = track;
    taken_.erase(std::next(begin), end);
    return track;
  }

 private:
  // Returns the entry that begins at this line.
  std::map<int, int>::iterator from(int line) {
    const auto next = taken_.upper_bound(line);
    return taken_.emplace_hint(next, line, std::prev(next)->second);
  }

  std::map<int, int> taken_{{std::numeric_limits<int>::min(), -1}};  // by the first of the lines
};

}  // namespace

int input_row(const Graph& graph, const End& end) {
  const Symbol& symbol = item_of(graph, end).symbol;
  return symbol.y + symbol.shape.inputs[static_cast<std::size_t>(end.port)];
}

int output_row(const Graph& graph, const End& end) {
  const Symbol& symbol = item_of(graph, end).symbol;
  return symbol.y + symbol.shape.outputs[static_cast<std::size_t>(end.port)];
}

std::vector<std::vector<std::size_t>> nets_by_column(const Graph& graph) {
  std::vector<std::vector<std::size_t>> nets(static_cast<std::size_t>(graph.columns));
  for (std::size_t n = 0; n < graph.nets.size(); ++n) {
    nets[static_cast<std::size_t>(item_of(graph, graph.nets[n].sources.front()).column)].push_back(n);
  }
  return nets;
}

std::vector<int> assign_tracks(const Graph& graph, const std::vector<std::size_t>& nets, int& clash) {
  std::vector<Span> spans = spans_of(graph, nets);
  spans.erase(std::remove_if(spans.begin(), spans.end(), [](const Span& span) { return span.top == span.bottom; }),
              spans.end());
  const std::vector<const Span*> order = in_order(spans);
  if (order.size() < spans.size()) {
    const std::unordered_set<const Span*> sorted(order.begin(), order.end());
    const auto last =
        std::find_if(spans.rbegin(), spans.rend(), [&](const Span& one) { return !sorted.contains(&one); });
    clash = graph.nets[nets[last->net]].targets.front().item;
    return {};
  }
  std::vector<int> tracks(nets.size(), -1);
  Skyline skyline;
  for (const Span* span : order) {
    tracks[span->net] = skyline.take(span->top, span->bottom);
  }
  return tracks;
}

void assign_rows(Graph& graph) {
  Rows(graph).run();
}

}  // namespace indurop::plc::draw
