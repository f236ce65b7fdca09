// SPDX-License-Identifier: Apache-2.0
// Age of a value when a module of another board reads it: at most one cycle of the writer plus the network transfer,
// because the boards' periods are not synchronized.

#include <algorithm>
#include <tuple>

#include "config/check/plant_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

bool is_periodic(const Module& module) {
  constexpr base::Nanos kCounted = std::chrono::hours(24 * 366);  // limit that avoids overflow of sums
  return module.operation == scheduler::Operation::Periodic && module.period > base::Nanos::zero() &&
         module.period < kCounted;
}

class AgeCheck {
 public:
  AgeCheck(PlantContext& context, std::vector<Route>& routes)
      : context_(context), uses_(context.uses), routes_(routes) {
    for (const schema::Variable& variable : context.schema.variables) {
      maxage_.emplace(variable.name, base::Nanos{variable.maxage_ns});
    }
  }

  void run() {
    for (Route& route : routes_) {
      check_rate(route);
      follow(route);
    }
    for (const auto& [key, flow] : flows_) {
      report(flow);
    }
  }

 private:
  // Variables that pass from one module to another at one rate.
  struct Flow {
    User writer;
    User reader;
    base::Nanos sent{};  // time between two values that leave the board
    std::vector<std::string> variables;
  };

  [[nodiscard]] base::Nanos maxage(const Route& route) const {
    const auto found = maxage_.find(route.variable);
    return found == maxage_.end() ? base::Nanos::zero() : found->second;
  }

  // Checks that the value does not become invalid between two transmissions.
  void check_rate(const Route& route) {
    const base::Nanos most = maxage(route);
    if (most == base::Nanos::zero()) {
      return;
    }
    const VariableRule* rule = rule_for(context_.plant, route.variable);
    const std::string name = base::in_quotes(route.variable);
    if (most <= kNetworkHop) {
      context_.report.warning(first_reader(route).places.file,
                              name + " comes from board " + base::in_quotes(context_.boards[route.owner].name) +
                                  " and its maxage is " + base::format_duration(most) +
                                  ", but the network alone may take " + base::format_duration(kNetworkHop) +
                                  "; raise maxage");
    } else if (rule != nullptr && route.every + kNetworkHop > most) {
      context_.report.warning(rule->place, name + " is sent every " + base::format_duration(route.every) +
                                               " at most, but its maxage is " + base::format_duration(most) +
                                               ", so it is invalid in between; send it more often or raise maxage");
    }
  }

  [[nodiscard]] const Module& first_reader(const Route& route) const {
    const auto& readers = uses_.variables().at(route.variable).readers;
    return uses_.module(
        *std::find_if(readers.begin(), readers.end(), [&](const User& reader) { return reader.board != route.owner; }));
  }

  void follow(Route& route) {
    const Users& users = uses_.variables().at(route.variable);
    for (const User& writer : users.writers) {
      const Module& from = uses_.module(writer);
      if (writer.board != route.owner || !is_periodic(from)) {
        continue;
      }
      // A value is sent with the first cycle of the writer after `every` has passed.
      const base::Nanos late = route.every % from.period;
      const base::Nanos sent =
          std::max(from.period, late > base::Nanos::zero() ? route.every - late + from.period : route.every);
      for (const User& reader : users.readers) {
        if (reader.board == route.owner || !is_periodic(uses_.module(reader))) {
          continue;
        }
        Flow& flow = flows_[{reader.board, reader.module, writer.board, writer.module, sent}];
        flow.writer = writer;
        flow.reader = reader;
        flow.sent = sent;
        flow.variables.push_back(route.variable);
        route.oldest = std::max(route.oldest, sent + kNetworkHop);
        check_age(route, flow);
      }
    }
  }

  void check_age(const Route& route, const Flow& flow) {
    const base::Nanos most = maxage(route);
    const bool reported = most <= kNetworkHop || route.every + kNetworkHop > most;
    if (most > base::Nanos::zero() && !reported && flow.sent + kNetworkHop > most) {
      context_.report.warning(uses_.module(flow.reader).places.file,
                              base::in_quotes(route.variable) + " is up to " +
                                  base::format_duration(flow.sent + kNetworkHop) + " old when " +
                                  uses_.name(flow.reader) + " reads it, its maxage is " + base::format_duration(most) +
                                  "; let " + uses_.name(flow.writer) + " run more often or raise maxage");
    }
  }

  void report(const Flow& flow) {
    constexpr std::size_t kMaxShown = 3;
    const auto cycles = flow.sent / uses_.module(flow.writer).period;
    context_.report.note(uses_.module(flow.reader).places.file,
                         uses_.name(flow.reader) + " gets " + base::enumerate(flow.variables, kMaxShown) + " from " +
                             uses_.name(flow.writer) + " up to " + base::format_duration(flow.sent + kNetworkHop) +
                             " old (0 to " + std::to_string(cycles) + (cycles == 1 ? " cycle of " : " cycles of ") +
                             uses_.module(flow.writer).name + " plus up to " + base::format_duration(kNetworkHop) +
                             " through the network)");
  }

  PlantContext& context_;
  const Uses& uses_;
  std::vector<Route>& routes_;
  std::map<std::string, base::Nanos> maxage_;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t, std::size_t, base::Nanos>, Flow> flows_;
};

}  // namespace

void check_ages(PlantContext& context, std::vector<Route>& routes) {
  AgeCheck(context, routes).run();
}

}  // namespace indurop::config
