// SPDX-License-Identifier: Apache-2.0
// Checks the pools that are sent between boards: that both ends have them, with the same type.

#include <algorithm>
#include <map>
#include <string_view>

#include "config/check/plant_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

const schema::Pool* find_pool(const schema::Schema& schema, std::string_view name) {
  const auto found = std::find_if(schema.pools.begin(), schema.pools.end(),
                                  [name](const schema::Pool& pool) { return pool.name == name; });
  return found == schema.pools.end() ? nullptr : &*found;
}

bool may_mean(std::string_view written, std::string_view full) {
  return full == written || (full.ends_with(written) && full.substr(0, full.size() - written.size()).ends_with("::"));
}

bool calls(const schema::ModuleFile& file, std::string_view symbol) {
  return std::find(file.imports.begin(), file.imports.end(), symbol) != file.imports.end();
}

class PoolCheck {
 public:
  explicit PoolCheck(PlantContext& context)
      : context_(context),
        report_(context.report),
        all_read_(std::all_of(context.boards.begin(), context.boards.end(),
                              [](const BoardView& board) { return board.result.ok(); })) {
    for (const schema::Pool& pool : context.schema.pools) {
      names_.push_back(pool.name);
    }
  }

  void run() {
    std::map<std::string, int> lines;
    for (PoolRoute& route : context_.plant.pools) {
      if (!find_full_name(route)) {
        continue;
      }
      const auto [first, is_first] = lines.try_emplace(route.name, route.place.line);
      if (!is_first) {
        report_.error(route.place, "a second <pool> for " + base::in_quotes(route.name) + ", the first is in line " +
                                       std::to_string(first->second) +
                                       "; a pool is sent by one board: write all boards that get it in `to` of the "
                                       "first");
        continue;
      }
      check(route);
    }
  }

 private:
  // Returns false after an error, or if the files of some board cannot be read, which has been reported.
  bool find_full_name(PoolRoute& route) {
    std::vector<std::string> meant;
    std::copy_if(names_.begin(), names_.end(), std::back_inserter(meant),
                 [&](const std::string& full) { return may_mean(route.name, full); });
    if (std::find(meant.begin(), meant.end(), route.name) != meant.end()) {
      return true;
    }
    if (meant.size() == 1) {
      route.name = meant.front();
      return true;
    }
    if (!meant.empty()) {
      report_.error(route.place, "<pool>: " + base::in_quotes(route.name) + " may be " + base::enumerate(meant) +
                                     "; write the name in full");
    } else if (all_read_) {
      report_.error(route.place, "<pool>: no module declares a pool " + base::in_quotes(route.name) +
                                     (names_.empty()   ? "; pools are declared in .glb files, see docs/pools.md"
                                      : report_.full() ? ""
                                                       : base::suggestion(route.name, names_)));
    }
    return false;
  }

  void check(const PoolRoute& route) {
    const schema::Pool* const sent = pool_on("from", route.from, route.name, route.from_place);
    if (sent != nullptr) {
      note_if_unused(route.from, route, route.from_place, {"indurop_pool_take"},
                     " fills chunks of it, so only programs outside of the node could");
    }
    for (std::size_t i = 0; i < route.to.size(); ++i) {
      const schema::Pool* const received = pool_on("to", route.to[i], route.name, route.to_places[i]);
      if (received == nullptr) {
        continue;
      }
      note_if_unused(route.to[i], route, route.to_places[i], {"indurop_pool_latest", "indurop_pool_next"},
                     " reads chunks of it, so only programs outside of the node could");
      if (sent != nullptr && sent->type_hash != received->type_hash) {
        const std::string what = schema::first_difference(sent->type, received->type);
        report_.error(route.to_places[i],
                      "pool " + base::in_quotes(route.name) + " differs between board " + base::in_quotes(route.from) +
                          " and board " + base::in_quotes(route.to[i]) + ": " + (what.empty() ? "other layout" : what) +
                          "; build the modules of both boards with the same .glb file");
      }
    }
  }

  const schema::Pool* pool_on(const char* attribute, const std::string& board, const std::string& pool,
                              base::SourcePlace place) {
    const BoardView* const view = view_of(board);
    const schema::Pool* const found = view == nullptr ? nullptr : find_pool(view->result.schema, pool);
    if (view == nullptr || found != nullptr || !view->result.ok()) {
      return found;
    }
    std::vector<std::string> others;
    for (const BoardView& other : context_.boards) {
      if (find_pool(other.result.schema, pool) != nullptr) {
        others.push_back(base::in_quotes(other.name));
      }
    }
    report_.error(place, std::string(attribute) + ": no module of board " + base::in_quotes(board) + " declares " +
                             base::in_quotes(pool) + ", only modules of " + base::enumerate(others) +
                             "; name one of these boards, or build a module of " + base::in_quotes(board) +
                             " with the .glb file of the pool");
    return nullptr;
  }

  // Notes that no module of the board both declares the pool and calls one of these functions.
  void note_if_unused(const std::string& board, const PoolRoute& route, base::SourcePlace place,
                      const std::vector<std::string_view>& functions, const char* text) {
    const auto& facts = view_of(board)->result.facts;
    const bool used = std::any_of(facts.begin(), facts.end(), [&](const ModuleFacts& one) {
      return find_pool(*one.schema, route.name) != nullptr &&
             std::any_of(functions.begin(), functions.end(),
                         [&](std::string_view function) { return calls(one.file, function); });
    });
    if (!used) {
      report_.note(place, "no module of board " + base::in_quotes(board) + " that declares " +
                              base::in_quotes(route.name) + text);
    }
  }

  [[nodiscard]] const BoardView* view_of(const std::string& board) const {
    const auto found = std::find_if(context_.boards.begin(), context_.boards.end(),
                                    [&board](const BoardView& one) { return one.name == board; });
    return found == context_.boards.end() ? nullptr : &*found;
  }

  PlantContext& context_;
  base::Diagnostics& report_;
  std::vector<std::string> names_;  // of all boards
  bool all_read_;
};

}  // namespace

void check_pools(PlantContext& context) {
  PoolCheck(context).run();
}

}  // namespace indurop::config
