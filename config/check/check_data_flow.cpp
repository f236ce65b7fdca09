// SPDX-License-Identifier: Apache-2.0
// Checks the data flow of one board with its access map: readers that run too early, age.

#include <algorithm>
#include <string>
#include <vector>

#include "config/check/access_map.h"
#include "config/check/data_flow.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

class AccessCheck {
 public:
  explicit AccessCheck(CheckContext& context) : context_(context), map_(make_access_map(context)) {}

  void run() {
    for (const auto& [name, access] : map_.variables) {
      context_.result.uses.push_back({name, names(access.readers), names(access.writers)});
    }
    context_.result.unknown_readers = map_.unknown_readers;
    context_.result.unknown_writers = map_.unknown_writers;
    if (!context_.result.table.order.empty()) {
      find_flows();
      check_order();
      report_ages();
    }
  }

 private:
  using Severity = base::Diagnostic::Severity;

  // Variables that pass from one periodic module to another; positions in execution order.
  struct Flow {
    std::size_t writer;
    std::size_t reader;
    std::vector<const schema::Variable*> variables;
    Age age;
  };

  [[nodiscard]] const Module& module(std::size_t index) const { return context_.config.modules[index]; }
  // Returns a periodic module by its position in the order of execution.
  [[nodiscard]] const Module& at(std::size_t position) const {
    return module(context_.result.periodic[context_.result.table.order[position]]);
  }
  [[nodiscard]] std::vector<std::string> names(const std::vector<std::size_t>& modules) const {
    std::vector<std::string> list;
    list.reserve(modules.size());
    for (const std::size_t i : modules) {
      list.push_back(module(i).name);
    }
    return list;
  }
  static std::string names_of_variables(const Flow& flow) {
    constexpr std::size_t kMaxShown = 3;
    std::vector<std::string> list;
    for (const schema::Variable* variable : flow.variables) {
      list.push_back(variable->name);
    }
    return base::enumerate(list, kMaxShown);
  }

  [[nodiscard]] Release release(std::size_t position) const {
    return {at(position).period, at(position).offset, position};
  }

  void find_flows() {
    const auto& order = context_.result.table.order;
    std::vector<std::size_t> position_of(context_.config.modules.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      position_of[context_.result.periodic[order[i]]] = i;
    }
    struct Found {
      Edge edge;
      const schema::Variable* variable;
    };
    std::vector<Found> found;
    for (const auto& [name, access] : map_.variables) {
      for (const std::size_t w : access.writers) {
        for (const std::size_t r : access.readers) {
          if (w != r && position_of[w] < order.size() && position_of[r] < order.size()) {
            found.push_back({{position_of[w], position_of[r]}, access.variable});
          }
        }
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.edge < b.edge; });
    for (const auto& [edge, variable] : found) {
      if (edges_.empty() || edges_.back() != edge) {
        flows_.push_back({edge.first, edge.second, {}, age_between(release(edge.first), release(edge.second))});
        edges_.push_back(edge);
      }
      flows_.back().variables.push_back(variable);
    }
  }

  [[nodiscard]] static bool too_early(const Flow& flow) { return flow.age.meet && flow.reader < flow.writer; }

  // Returns the priorities with which readers run after writers.
  [[nodiscard]] std::string better_order(const Flow& early) {
    const std::size_t count = context_.result.table.order.size();
    const bool distinct = at(early.reader).priority != at(early.writer).priority;
    std::vector<std::size_t> swapped(count);
    for (std::size_t i = 0; i < count; ++i) {
      swapped[i] = i == early.reader ? early.writer : i == early.writer ? early.reader : i;
    }
    const bool swap_helps = std::none_of(flows_.begin(), flows_.end(), [&](const Flow& flow) {
      const bool concerned = flow.reader == early.reader || flow.reader == early.writer ||
                             flow.writer == early.reader || flow.writer == early.writer;
      return concerned && group_[flow.reader] != group_[flow.writer] && swapped[flow.reader] < swapped[flow.writer];
    });
    if (distinct && swap_helps) {
      return "swap their priorities: " + at(early.writer).name + " " + std::to_string(at(early.reader).priority) +
             ", " + at(early.reader).name + " " + std::to_string(at(early.writer).priority);
    }
    if (best_order_.empty()) {
      best_order_ = writers_first(count, edges_);
    }
    std::string text = "give them priorities in the order ";
    constexpr std::size_t kMaxShown = 20;
    for (std::size_t i = 0; i < best_order_.size() && i < kMaxShown; ++i) {
      text += (i == 0 ? "" : " > ") + at(best_order_[i]).name;
    }
    return text + (best_order_.size() > kMaxShown ? " > ..." : "");
  }

  void check_order() {
    if (edges_.empty()) {
      return;
    }
    group_ = circles(context_.result.table.order.size(), edges_);
    for (const Flow& flow : flows_) {
      const bool round = group_[flow.reader] == group_[flow.writer];
      if (!too_early(flow) || context_.report.full(round ? Severity::Note : Severity::Warning)) {
        continue;
      }
      const Module& reader = at(flow.reader);
      const Module& writer = at(flow.writer);
      const std::string what = reader.name + " runs before " + writer.name + " and reads the " +
                               names_of_variables(flow) + " it wrote " + base::format_duration(flow.age.most) +
                               " before" + (flow.age.meetings > 1 ? " whenever both are due" : "");
      if (round) {
        context_.report.note(reader.places.priority,
                             what + "; they exchange values in a cycle, so one of them has to run first");
      } else {
        context_.report.warning(reader.places.priority, what + "; " + better_order(flow));
      }
    }
  }

  static std::string age_text(const Age& age, base::Nanos basic) {
    if (age.most == base::Nanos::zero()) {
      return "within the same basic period";
    }
    const std::string most = std::to_string(age.most / basic);
    const std::string periods = age.most == basic ? " basic period)" : " basic periods)";
    return age.least == age.most ? base::format_duration(age.most) + " old (" + most + periods
                                 : "up to " + base::format_duration(age.most) + " old (" +
                                       std::to_string(age.least / basic) + " to " + most + periods;
  }

  void report_ages() {
    for (const Flow& flow : flows_) {
      if (!context_.report.full(Severity::Note)) {
        context_.report.note(at(flow.reader).places.file, at(flow.reader).name + " gets " + names_of_variables(flow) +
                                                              " from " + at(flow.writer).name + " " +
                                                              age_text(flow.age, context_.result.table.basic_period));
      }
      for (const schema::Variable* variable : flow.variables) {
        if (variable->maxage_ns > 0 && flow.age.most.count() > variable->maxage_ns) {
          context_.report.warning(at(flow.reader).places.file,
                                  base::in_quotes(variable->name) + " is up to " +
                                      base::format_duration(flow.age.most) + " old when " + at(flow.reader).name +
                                      " reads it, its maxage is " +
                                      base::format_duration(base::Nanos{variable->maxage_ns}) + "; let " +
                                      at(flow.writer).name + " run more often or raise maxage");
        }
      }
    }
  }

  CheckContext& context_;
  AccessMap map_;
  std::vector<Flow> flows_;
  std::vector<Edge> edges_;         // of flows_
  std::vector<std::size_t> group_;  // by position
  std::vector<std::size_t> best_order_;
};

}  // namespace

void check_data_flow(CheckContext& context) {
  AccessCheck(context).run();
}

}  // namespace indurop::config
