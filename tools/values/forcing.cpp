// SPDX-License-Identifier: Apache-2.0
#include "tools/values/forcing.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>

#include "explain/orders.h"
#include "rt/clock.h"
#include "tools/values/value_source.h"

namespace indurop::tools {
namespace {

std::string what_failed(const Error& error) {
  if (error.code == Errc::NoSpace) {
    return fmt::format("{} values are forced already, which is the most; let some go: indurop unforce",
                       vars::kMostForces);
  }
  return error.code == Errc::Busy ? fmt::format("{}: somebody who has it is stopped; try again", error.where)
                                  : fmt::format("{} ({})", error.where, to_string(error.code));
}

bool can_be_forced(const schema::Type& type) {
  return type.dims.empty() && type.base != schema::Base::Struct;
}

bool lies_in(const vars::Force& force, const Item& item) {
  const std::uint64_t begin = item.place.offset;
  return force.variable == item.entry && force.offset >= begin && force.offset < begin + item.place.type.size();
}

// A text is forced word by word, up to its end.
Status force_text(vars::Store& store, const Assignment& one, rt::MonoTime until) {
  for (const vars::Force& known : store.forces()) {
    if (const Status gone = lies_in(known, one.item) ? store.let_go(*known.variable, known.offset) : Status(); !gone) {
      return gone;
    }
  }
  const auto end = std::find(one.bytes.begin(), one.bytes.end(), std::uint8_t{0});
  std::size_t left = static_cast<std::size_t>(end - one.bytes.begin()) + (end == one.bytes.end() ? 0 : 1);
  std::span<const std::uint8_t> bytes(one.bytes);
  for (std::uint32_t offset = one.item.place.offset; left > 0;) {
    constexpr std::size_t kWord = 8;
    const std::size_t size = std::min(kWord, std::bit_floor(left));
    if (const Status forced = store.force(*one.item.entry, offset, bytes.first(size), until); !forced) {
      return forced;
    }
    bytes = bytes.subspan(size);
    offset += static_cast<std::uint32_t>(size);
    left -= size;
  }
  return {};
}

void note_order(const Context& context, const vars::Store& store, const char* action, const std::string& name,
                const std::string& value, std::int64_t until_ns = 0) {
  if (context.values->here()) {
    explain::note_order(context.node,
                        {rt::to_ns(store.now()), 0, context.who, context.from, action, name, value, until_ns});
  }
}

template <class Wanted>
int let_go_if(Context& context, vars::Store& store, std::vector<std::string>& gone, Wanted wanted) {
  for (const vars::Force& one : store.forces()) {
    if (!wanted(one)) {
      continue;
    }
    const std::string name = schema::part_at(store.schema().variables[one.variable->schema_index], one.offset).name;
    const Status status = store.let_go(*one.variable, one.offset);
    if (!status.ok() && status.error().code != Errc::NotFound) {
      context.out.error(what_failed(status.error()));
      return kUnreachable;
    }
    note_order(context, store, "unforce", name, {});
    gone.push_back(name);
  }
  return kOk;
}

}  // namespace

int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments) {
  for (const Assignment& one : assignments) {
    const Item& item = one.item;
    if (const auto done = context.values->set(store, item.name, *item.entry, item.place, one.bytes); !done) {
      return report(context.out, done.error());
    }
    note_order(context, store, "set", one);
  }
  return kOk;
}

void note_order(const Context& context, const vars::Store& store, const char* action, const Assignment& one) {
  note_order(context, store, action, one.item.name, schema::format_value(one.item.place.type, one.bytes));
}

int hold_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments, std::int64_t for_ns) {
  int code = kOk;
  for (const Assignment& one : assignments) {
    if (!can_be_forced(one.item.place.type)) {
      context.out.error(fmt::format("{} is a {}; force its numbers one by one", one.item.name,
                                    schema::display_name(one.item.place.type)));
      code = kFailed;
    }
  }
  if (code != kOk) {
    return code;
  }
  const rt::MonoTime until = for_ns > 0 ? store.now() + std::chrono::nanoseconds(for_ns) : vars::kForever;
  for (const Assignment& one : assignments) {
    const Item& item = one.item;
    const Status forced = item.place.type.base == schema::Base::Text
                              ? force_text(store, one, until)
                              : store.force(*item.entry, item.place.offset, one.bytes, until);
    if (!forced.ok()) {
      context.out.error(fmt::format("{} is not forced: {}", item.name, what_failed(forced.error())));
      return forced.error().code == Errc::Busy ? kUnreachable : kFailed;
    }
    note_order(context, store, "force", item.name, schema::format_value(item.place.type, one.bytes),
               until == vars::kForever ? INT64_MAX : rt::to_ns(until));
  }
  return kOk;
}

int let_values_go(Context& context, vars::Store& store, const std::vector<Item>& items,
                  std::vector<std::string>& gone) {
  return let_go_if(context, store, gone, [&items](const vars::Force& one) {
    return std::any_of(items.begin(), items.end(), [&one](const Item& item) { return lies_in(one, item); });
  });
}

int let_all_go(Context& context, vars::Store& store, std::vector<std::string>& gone) {
  return let_go_if(context, store, gone, [](const vars::Force& /*one*/) { return true; });
}

// Writing to a forced value would be for nothing.
bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments) {
  bool any = false;
  for (const vars::Force& force : store.forces()) {
    for (const auto& [item, bytes] : assignments) {
      const std::uint64_t begin = item.place.offset;
      if (force.variable == item.entry && force.offset < begin + bytes.size() && begin < force.offset + force.size) {
        context.out.error(fmt::format("{} is forced; release it first: indurop unforce '{}'", item.name, item.name));
        any = true;
      }
    }
  }
  return any;
}

}  // namespace indurop::tools
