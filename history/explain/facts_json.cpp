// SPDX-License-Identifier: Apache-2.0
#include "history/explain/facts_json.h"

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "store/operate/journal.h"

namespace indurop::explain {
namespace {

using base::Json;

// One list of fields for both directions.
class Writer {
 public:
  template <class T>
  void operator()(const char* name, const T& value) {
    json[name] = value;
  }
  Json json = Json::object();
};

class Reader {
 public:
  explicit Reader(const Json& from) : from_(from) {}

  void operator()(const char* name, std::string& to) const { base::read(from_, name, to); }
  void operator()(const char* name, std::vector<std::string>& to) const { base::read(from_, name, to); }
  void operator()(const char* name, bool& to) const { base::read(from_, name, to); }
  template <std::integral T>
  requires(!std::same_as<T, bool>) void operator()(const char* name, T& to) const {
    if (const auto natural = from_[name].natural();
        natural && *natural <= std::uint64_t{std::numeric_limits<T>::max()}) {
      to = static_cast<T>(*natural);
    } else if (const auto integer = from_[name].integer();
               integer && *integer < 0 && *integer >= std::int64_t{std::numeric_limits<T>::lowest()}) {
      to = static_cast<T>(*integer);
    }
  }

 private:
  const Json& from_;
};

constexpr auto kModule = [](auto&& visit, auto& fact) {
  visit("name", fact.name);
  visit("type", fact.type);
  visit("operation", fact.operation);
  visit("period_ns", fact.period_ns);
  visit("offset_ns", fact.offset_ns);
  visit("deadline_ns", fact.deadline_ns);
  visit("priority", fact.priority);
  visit("core", fact.core);
  visit("fifo_priority", fact.fifo_priority);
  visit("state", fact.state);
  visit("runs", fact.runs);
  visit("faults", fact.faults);
  visit("restarts", fact.restarts);
  visit("fault_tick", fact.fault_tick);
  visit("fault", fact.fault);
};

constexpr auto kKernel = [](auto&& visit, auto& fact) {
  visit("from_ns", fact.from_ns);
  visit("to_ns", fact.to_ns);
  visit("core", fact.core);
  visit("thread", fact.thread);
  visit("waited_ns", fact.waited_ns);
  visit("major_faults", fact.major_faults);
  visit("stolen_ns", fact.stolen_ns);
};

constexpr auto kBoard = [](auto&& visit, auto& fact) {
  visit("name", fact.name);
  visit("state", fact.state);
  visit("problem", fact.problem);
  visit("heard_ns", fact.heard_ns);
  visit("losses", fact.losses);
  visit("lost_updates", fact.lost_updates);
};

constexpr auto kOwn = [](auto&& visit, auto& facts) {
  visit("board", facts.board);
  visit("virtual", facts.is_virtual);
  visit("realtime", facts.realtime);
  visit("basic_period_ns", facts.basic_period_ns);
  visit("epoch_ns", facts.epoch_ns);
  visit("now_ns", facts.now_ns);
  visit("tick", facts.tick);
  visit("lost_ticks", facts.lost_ticks);
  visit("schedule", facts.schedule);
  visit("schedule_tick", facts.schedule_tick);
  visit("stop_reason", facts.stop_reason);
  visit("wall_minus_node_ns", facts.wall_minus_node_ns);
  visit("kernel_from_ns", facts.kernel_from_ns);
  visit("kernel_to_ns", facts.kernel_to_ns);
};

template <class Fact, class Fields>
Json list_of(const std::vector<Fact>& facts, Fields fields) {
  Json list = Json::array();
  for (const Fact& fact : facts) {
    Writer writer;
    fields(writer, fact);
    list.push_back(std::move(writer.json));
  }
  return list;
}

template <class Fact, class Fields>
void read_list(const Json& list, std::vector<Fact>& to, Fields fields) {
  to.clear();  // a recording has two such texts, of its begin and of its end: the later one counts
  for (const Json& one : list.values()) {
    Fact fact;
    fields(Reader(one), fact);
    to.push_back(std::move(fact));
  }
}

}  // namespace

std::string facts_text(const Facts& facts) {
  Writer writer;
  kOwn(writer, facts);
  writer.json["modules"] = list_of(facts.modules, kModule);
  Json orders = Json::array();
  for (const OrderFact& order : facts.orders) {
    orders.push_back(operate::json_of(order));
  }
  writer.json["orders"] = std::move(orders);
  writer.json["kernel"] = list_of(facts.kernel, kKernel);
  writer.json["boards"] = list_of(facts.boards, kBoard);
  return writer.json.dump() + "\n";
}

bool read_facts(std::string_view text, Facts& facts) {
  const auto json = Json::parse(text);
  if (!json || !json->is_object()) {
    return false;
  }
  kOwn(Reader(*json), facts);
  read_list((*json)["modules"], facts.modules, kModule);
  facts.orders.clear();
  for (const Json& one : (*json)["orders"].values()) {
    OrderFact order;
    operate::read_order(one, order);
    facts.orders.push_back(std::move(order));
  }
  read_list((*json)["kernel"], facts.kernel, kKernel);
  read_list((*json)["boards"], facts.boards, kBoard);
  return true;
}

Json json_of(const Answer& answer) {
  return {{"cause", to_text(answer.cause)},
          {"culprit", answer.culprit},
          {"text", answer.text},
          {"evidence", answer.evidence}};
}

}  // namespace indurop::explain
