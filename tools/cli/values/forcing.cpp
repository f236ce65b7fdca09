// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/forcing.h"

#include <fmt/format.h>

#include <optional>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "store/operate/audit.h"
#include "store/operate/set.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {
namespace {

bool is_here(const Context& context) {
  return context.values == nullptr || context.values->here();
}

}  // namespace

operate::Who who_orders(const Context& context) {
  return {context.who, context.from, context.reason};
}

int report(Context& context, const operate::Refusal& refusal) {
  for (const std::string& reason : refusal.reasons) {
    context.out.error(refusal.why == operate::Why::Locked ? fmt::format("node '{}': {}", context.node, reason)
                                                          : reason);
  }
  return refusal.why == operate::Why::Busy || refusal.why == operate::Why::Absent ? kUnreachable : kFailed;
}

void note_for_audit(const Context& context, const std::string& node, const char* action, const std::string& what) {
  (void)operate::append_audit(operate::usual_audit_file(),
                              {rt::wall_ns(), base::user_name(), "", node, action, what, "done", context.reason});
}

void note_for_audit(const Context& context, const char* action, const std::string& what) {
  if (context.who.empty() && is_here(context)) {
    note_for_audit(context, context.node, action, what);
  }
}

std::string text_of(const std::vector<Assignment>& assignments) {
  std::string text;
  for (const Assignment& one : assignments) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", one.item.name, one.text);
  }
  return text;
}

bool may(Context& context, const std::string& node, vars::Act act) {
  const auto locked = is_here(context) ? operate::refusal(node, act) : std::nullopt;
  if (locked) {
    context.out.error(fmt::format("node '{}': {}", node, locked->text()));
  }
  return !locked;
}

bool may_set(Context& context, const std::vector<Assignment>& assignments) {
  const auto locked = is_here(context) ? operate::refusal_to_set(context.node, assignments) : std::nullopt;
  if (locked) {
    report(context, *locked);
  }
  return !locked;
}

bool any_forced(Context& context, const vars::Store& store, const std::vector<Assignment>& assignments) {
  const auto forced = operate::forced(store, assignments);
  if (forced) {
    report(context, *forced);
  }
  return forced.has_value();
}

int set_values(Context& context, vars::Store& store, const std::vector<Assignment>& assignments) {
  if (is_here(context)) {
    if (const auto done = operate::set(context.node, store, assignments, who_orders(context)); !done) {
      return report(context, done.error());
    }
    note_for_audit(context, "set", text_of(assignments));
    return kOk;
  }
  for (const Assignment& one : assignments) {
    const Item& item = one.item;
    if (const auto done = context.values->set(store, item.name, *item.entry, item.place, one.bytes); !done) {
      return report(context.out, done.error());
    }
  }
  return kOk;
}

}  // namespace indurop::tools
