// SPDX-License-Identifier: Apache-2.0
#include "config/xml/pool_reader.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "config/xml/external_reader.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr const char* kPoolExample = R"(<pool name="cell::Vision::camera" from="vision" to="control"/>)";
constexpr std::string_view kBlanks = " \t\r\n";

// Fills the names of boards that the value has, separated by blanks, with their places.
void split_boards(const base::Attribute& value, PoolRoute& route) {
  const std::string_view text = value.value;
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    route.to.emplace_back(text.substr(at, end - at));
    base::SourcePlace place = value.value_place;
    place.column += static_cast<int>(base::characters(text.substr(0, at)));
    route.to_places.push_back(place);
    at = text.find_first_not_of(kBlanks, end);
  }
}

class PoolBoards {
 public:
  PoolBoards(const Plant& plant, base::Diagnostics& report) : report_(report) {
    for (const Board& board : plant.boards) {
      names_.push_back(board.name);
    }
  }

  void check(const PoolRoute& route) {
    exists("from", route.from, route.from_place);
    for (std::size_t i = 0; i < route.to.size(); ++i) {
      const std::string& name = route.to[i];
      const auto before = route.to.begin() + static_cast<std::ptrdiff_t>(i);
      if (name == route.from) {
        report_.error(route.to_places[i], "to: " + base::in_quotes(name) +
                                              " is the board that the chunks come from; its modules have them anyway: "
                                              "name other boards");
      } else if (std::find(route.to.begin(), before, name) != before) {
        report_.error(route.to_places[i], "to: " + base::in_quotes(name) + " is named twice; remove one");
      } else {
        exists("to", name, route.to_places[i]);
      }
    }
  }

 private:
  void exists(const char* attribute, const std::string& name, base::SourcePlace place) {
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
      report_.error(place, std::string(attribute) + ": there is no board " + base::in_quotes(name) +
                               (report_.full() ? "" : base::suggestion(name, names_)));
    }
  }

  base::Diagnostics& report_;
  std::vector<std::string> names_;
};

}  // namespace

std::optional<PoolRoute> read_pool_route(const base::Element& element, FirstPlaces& pools, base::Diagnostics& report) {
  check_attributes(element, {"name", "from", "to", "every"}, report);
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  PoolRoute route;
  const base::Attribute* const name = need_attribute(element, "name", kPoolExample, report);
  const base::Attribute* const from = need_attribute(element, "from", kPoolExample, report);
  const base::Attribute* const to = need_attribute(element, "to", kPoolExample, report);
  optional_attribute(
      element, "every", [&route](const std::string& text) { return every_problem(text, route.every); }, report);
  if (name == nullptr || from == nullptr || to == nullptr) {
    return std::nullopt;
  }
  route.name = name->value;
  route.place = name->value_place;
  route.from = from->value;
  route.from_place = from->value_place;
  split_boards(*to, route);
  if (route.to.empty()) {
    report.error(to->value_place, "to: no board is named; write, for example, to=\"control\"");
    return std::nullopt;
  }
  const auto [first, is_first] = pools.try_emplace(route.name, element.place);
  if (!is_first) {
    report.error(element.place, "a second <pool> " + base::in_quotes(route.name) + ", the first is in line " +
                                    std::to_string(first->second.line) +
                                    "; a pool is sent by one board: write all boards that get it in `to` of the first");
    return std::nullopt;
  }
  return route;
}

void check_pool_boards(const Plant& plant, base::Diagnostics& report) {
  PoolBoards boards(plant, report);
  for (const PoolRoute& route : plant.pools) {
    boards.check(route);
  }
}

}  // namespace indurop::config
