// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/pool_view.h"

#include <fmt/format.h>

#include "tools/client/text/units.h"

namespace indurop::tools {

std::vector<PoolView> view_pools(const std::string& node, const vars::Store& store, std::string_view pattern) {
  std::vector<PoolView> views;
  for (const schema::Pool& declared : store.schema().pools) {
    if (!schema::glob_match(pattern, declared.name)) {
      continue;
    }
    const auto pool = pools::Pool::open(node, declared.name, declared.type_hash, vars::Mode::ReadOnly);
    if (!pool) {
      continue;
    }
    PoolView view{pool->shape(), declared.type.name, pool->usage()};
    if (view.usage.newest_ns != 0) {
      view.newest_age_ns = rt::to_ns(store.now()) - view.usage.newest_ns;
    }
    views.push_back(std::move(view));
  }
  return views;
}

std::vector<std::string> lines_of(const PoolView& view) {
  const pools::Usage& usage = view.usage;
  std::string line = fmt::format("{}: {} chunks of {}, {} free, {} published", printable(view.shape.name),
                                 view.shape.chunks, human_bytes(view.shape.chunk_bytes), usage.free, usage.numbers);
  if (view.newest_age_ns >= 0) {
    line += fmt::format(", the newest {} ago", human_ns(view.newest_age_ns));
  }
  line += fmt::format("; drops: {} without a free chunk, {} missed by readers", usage.without_a_chunk, usage.missed);
  if (usage.recovered > 0) {
    line += fmt::format("; {} recovered from ended processes", usage.recovered);
  }
  std::vector<std::string> lines{std::move(line)};
  for (const pools::User& user : usage.users) {
    std::string text = fmt::format("{} (pid {})", printable(user.name), user.pid);
    if (user.published > 0 || user.without_a_chunk > 0 || user.fills > 0) {
      text += fmt::format(": wrote {}, {} without a free chunk, fills {}", user.published, user.without_a_chunk,
                          user.fills);
    }
    if (user.seen > 0 || user.holds > 0) {
      text += fmt::format(": read up to {}, missed {}, holds {}", user.seen, user.missed, user.holds);
    }
    lines.push_back(std::move(text));
  }
  return lines;
}

JsonValue json_of(const std::vector<PoolView>& views) {
  JsonValue list = JsonValue::array();
  for (const PoolView& view : views) {
    JsonValue users = JsonValue::array();
    for (const pools::User& user : view.usage.users) {
      users.push_back({{"name", user.name},
                       {"pid", user.pid},
                       {"published", user.published},
                       {"without_a_chunk", user.without_a_chunk},
                       {"fills", user.fills},
                       {"seen", user.seen},
                       {"missed", user.missed},
                       {"holds", user.holds}});
    }
    list.push_back({{"name", view.shape.name},
                    {"type", view.type},
                    {"chunks", view.shape.chunks},
                    {"chunk_bytes", view.shape.chunk_bytes},
                    {"free", view.usage.free},
                    {"published", view.usage.numbers},
                    {"newest_age_ns", view.newest_age_ns < 0 ? JsonValue() : JsonValue(view.newest_age_ns)},
                    {"without_a_chunk", view.usage.without_a_chunk},
                    {"missed", view.usage.missed},
                    {"recovered", view.usage.recovered},
                    {"users", std::move(users)}});
  }
  return list;
}

}  // namespace indurop::tools
