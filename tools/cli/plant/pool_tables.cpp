// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/pool_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/schema/schema.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using PoolNames = std::vector<std::string>;

bool declares(const schema::Schema& schema, const std::string& pool) {
  return std::any_of(schema.pools.begin(), schema.pools.end(),
                     [&pool](const schema::Pool& one) { return one.name == pool; });
}

Cell names_of_pool(const PoolNames& names) {
  return {fmt::format("{}", fmt::join(names, ", ")), JsonValue(names)};
}

std::vector<Cell> shape_of(const schema::Pool& pool) {
  const std::uint32_t chunks = pool.type.dims.empty() ? 0 : pool.type.dims[0];
  return {Cell(pool.name), Cell(std::to_string(chunks), chunks),
          Cell(human_bytes(pool.type.element_size), pool.type.element_size), Cell(pool.type.name)};
}

std::vector<Column> shape_columns() {
  return {{"POOL", "name"},
          {"CHUNKS", "chunks", Align::Right},
          {"OF", "chunk_bytes", Align::Right},
          {"TYPE", "type", Align::Left, 2}};
}

Table table_with(std::vector<Column> further) {
  std::vector<Column> columns = shape_columns();
  columns.insert(columns.end(), further.begin(), further.end());
  return Table(std::move(columns));
}

std::vector<Cell> row_with(const schema::Pool& pool, std::vector<Cell> further) {
  std::vector<Cell> cells = shape_of(pool);
  cells.insert(cells.end(), further.begin(), further.end());
  return cells;
}

}  // namespace

Table pool_table(const CheckedConfig& checked) {
  Table table = table_with({{"DECLARED BY", "modules"}});
  for (const schema::Pool& pool : checked.check.schema.pools) {
    PoolNames modules;
    for (std::size_t i = 0; i < checked.check.facts.size(); ++i) {
      if (declares(*checked.check.facts[i].schema, pool.name)) {
        modules.push_back(checked.config.modules[i].name);
      }
    }
    table.add(row_with(pool, {names_of_pool(modules)}));
  }
  return table;
}

Table pool_table(const CheckedPlant& checked) {
  Table table = table_with(
      {{"DECLARED ON", "boards"}, {"FROM", "from"}, {"TO", "to"}, {"AT MOST EVERY", "every_ns", Align::Right, 1}});
  std::map<std::string, const schema::Pool*> pools;
  for (const config::CheckResult& board : checked.check.boards) {
    for (const schema::Pool& pool : board.schema.pools) {
      pools.try_emplace(pool.name, &pool);
    }
  }
  for (const auto& [name, pool] : pools) {
    PoolNames boards;
    for (std::size_t i = 0; i < checked.check.boards.size(); ++i) {
      if (declares(checked.check.boards[i].schema, name)) {
        boards.push_back(checked.plant.boards[i].name);
      }
    }
    const auto& routes = checked.plant.pools;
    const auto route =
        std::find_if(routes.begin(), routes.end(), [&key = name](const config::PoolRoute& r) { return r.name == key; });
    const config::PoolRoute sent = route == routes.end() ? config::PoolRoute() : *route;
    const bool limited = sent.every > base::Nanos::zero();
    table.add(row_with(*pool, {names_of_pool(boards), Cell(sent.from), names_of_pool(sent.to),
                               Cell(limited ? base::format_duration(sent.every) : "", sent.every.count())}));
  }
  return table;
}

Table pool_table(const schema::Schema& schema, const std::vector<std::string>& globs, const std::string& type) {
  Table table = table_with({{"DESCRIPTION", "description", Align::Left, 1}, {"", "source"}});
  for (const schema::Pool& pool : schema.pools) {
    const bool wanted = globs.empty() || std::any_of(globs.begin(), globs.end(), [&pool](const std::string& glob) {
                          return schema::glob_match(glob, pool.name);
                        });
    if (wanted && (type.empty() || schema::glob_match(type, pool.type.name))) {
      table.add(row_with(pool, {Cell(pool.description), Cell(pool.source)}));
    }
  }
  return table;
}

std::string counted_pools(std::size_t number) {
  return number == 0 ? "" : ", " + counted(number, "pool");
}

}  // namespace indurop::tools
