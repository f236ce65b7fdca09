// SPDX-License-Identifier: Apache-2.0
#include "config/xml/module_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <span>

#include "config/xml/module_file.h"
#include "config/xml/reader.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;
using scheduler::OverrunPolicy;

class ModuleReader {
 public:
  ModuleReader(const base::Element& element, const std::filesystem::path& folder, base::Diagnostics& report)
      : element_(element), folder_(folder), report_(report) {}

  Module read() {
    module_.place = element_.place;
    check_attributes(element_, {}, report_);
    check_no_text(element_, report_);
    for (const base::Element& child : element_.children) {
      read_child(child);
    }
    config::check_rules(module_, given_, report_);
    return std::move(module_);
  }

 private:
  struct Known {
    std::string_view name;
    bool repeatable;
    void (ModuleReader::*read)(const base::Element&);
  };
  static std::span<const Known> known_elements() {
    static constexpr std::array<Known, 21> kKnown{{
        {"filename", false, &ModuleReader::read_file},     {"name", false, &ModuleReader::read_name},
        {"moduletype", false, &ModuleReader::read_type},   {"operationtype", false, &ModuleReader::read_operation},
        {"period", false, &ModuleReader::read_period},     {"offset", false, &ModuleReader::read_offset},
        {"priority", false, &ModuleReader::read_priority}, {"deadline", false, &ModuleReader::read_deadline},
        {"budget", false, &ModuleReader::read_budget},     {"core", false, &ModuleReader::read_core_element},
        {"overrun", false, &ModuleReader::read_overrun},   {"position", false, &ModuleReader::read_position},
        {"standby", false, &ModuleReader::read_standby},   {"signal", false, &ModuleReader::read_signal_element},
        {"argument", true, &ModuleReader::read_argument},  {"access", false, &ModuleReader::read_access},
        {"restart", false, &ModuleReader::read_restart},   {"failsafe", true, &ModuleReader::read_failsafe},
        {"property", true, &ModuleReader::read_property},  {"wcet", false, &ModuleReader::read_wcet},
        {"after", true, &ModuleReader::read_after},
    }};
    return kKnown;
  }

  void read_child(const base::Element& child) {
    const auto known = known_elements();
    const auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.name == child.name; });
    if (found == known.end()) {
      std::vector<std::string> names;
      for (const Known& k : known) {
        names.emplace_back(k.name);
      }
      given_.misspelt.insert(base::closest_name(child.name, names));
      is_known(child, element_, names, report_);
      return;
    }
    if (found->repeatable) {
      given_.elements.try_emplace(child.name, child.place);
    } else if (!is_first(child, "this <module>", given_.elements, report_)) {
      return;
    }
    (this->*found->read)(child);
  }

  // Returns false if the text is not one of the words, which is reported.
  template <class T>
  bool choose(const base::Element& element, const std::vector<std::string>& words, std::initializer_list<T> values,
              T& into) {
    const auto index = config::choose(element, words, report_);
    into = index ? *(values.begin() + *index) : into;
    return index.has_value();
  }

  void duration(const base::Element& element, bool zero_allowed, base::Nanos& into, base::SourcePlace& place) {
    place = element.text.empty() ? place : element.text_place;
    into = duration_of(element, zero_allowed, report_).value_or(into);
  }

  void read_file(const base::Element& e) {
    const auto text = text_of(e, "./control.so", report_);
    if (!text) {
      return;
    }
    module_.places.file = e.text_place;
    if (is_file_name(e, *text, report_)) {
      module_.file_as_written = *text;
      module_.file = module_file(folder_, *text);
    }
  }

  void read_name(const base::Element& e) {
    const auto text = text_of(e, "control", report_);
    if (!text) {
      return;
    }
    module_.places.name = e.text_place;
    const bool plain = std::all_of(text->begin(), text->end(), [](char c) {
      return static_cast<unsigned char>(c) >= 0x80 || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
             (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '.' || c == '+';
    });
    if (!plain) {
      report_.error(e.text_place,
                    base::in_quotes(*text) + " is not a module name; use letters, digits, '_', '-', '.' and '+'");
    } else if (text->size() >= scheduler::kNameLength) {
      report_.error(e.text_place, "this name is longer than " + std::to_string(scheduler::kNameLength - 1) +
                                      " bytes; choose a shorter one");
    } else {
      module_.name = *text;
    }
  }

  void read_type(const base::Element& e) {
    given_.type = choose(e, {"thread", "process"}, {ModuleType::Thread, ModuleType::Process}, module_.type);
  }

  void read_operation(const base::Element& e) {
    given_.operation = choose(e, {"periodic", "sporadic", "non-real"},
                              {Operation::Periodic, Operation::Sporadic, Operation::NonReal}, module_.operation);
  }

  void read_period(const base::Element& e) { duration(e, false, module_.period, module_.places.period); }
  void read_offset(const base::Element& e) { duration(e, true, module_.offset, module_.places.offset); }
  void read_deadline(const base::Element& e) { duration(e, false, module_.deadline, module_.places.deadline); }
  void read_wcet(const base::Element& e) { duration(e, false, module_.wcet, module_.places.wcet); }
  void read_budget(const base::Element& e) {
    if (e.text == "off" && e.children.empty()) {
      check_attributes(e, {}, report_);
      module_.budget = kNoBudget;
      return;
    }
    base::SourcePlace place;
    duration(e, false, module_.budget, place);
  }

  void read_priority(const base::Element& e) {
    const auto text = text_of(e, "1", report_);
    if (!text) {
      return;
    }
    module_.places.priority = e.text_place;
    constexpr std::int64_t kLow = std::numeric_limits<std::int32_t>::min();
    constexpr std::int64_t kHigh = std::numeric_limits<std::int32_t>::max();
    if (const auto value = read_integer(*text, kLow, kHigh)) {
      module_.priority = static_cast<int>(*value);
    } else {
      report_.error(e.text_place, "<priority>: " + base::in_quotes(*text) + " is not a whole number from " +
                                      std::to_string(kLow) + " to " + std::to_string(kHigh) +
                                      "; the lowest value runs first");
    }
  }

  void read_core_element(const base::Element& e) {
    module_.places.core = e.text_place;
    module_.core = read_core(e, report_);
  }

  void read_after(const base::Element& e) {
    if (const auto text = text_of(e, "control", report_)) {
      module_.places.after.push_back(e.text_place);
      module_.after.push_back(*text);
    }
  }

  void read_standby(const base::Element& e) {
    if (const auto text = text_of(e, "backup", report_)) {
      module_.places.standby = e.text_place;
      module_.standby = *text;
    }
  }

  void read_overrun(const base::Element& e) {
    choose(e, {"skip", "catch-up", "stop-module", "stop-node"},
           {OverrunPolicy::Skip, OverrunPolicy::CatchUp, OverrunPolicy::StopModule, OverrunPolicy::StopNode},
           module_.overrun);
  }

  void read_position(const base::Element& e) {
    choose(e, {"after-base", "after-all"}, {true, false}, module_.after_base);
  }

  void read_signal_element(const base::Element& e) {
    const auto text = text_of(e, "SIGUSR1", report_);
    if (!text) {
      return;
    }
    module_.places.signal = e.text_place;
    SignalText read = read_signal(*text);
    if (read.value) {
      module_.signal = *read.value;
    } else {
      report_.error(e.text_place, "<signal>: " + read.problem);
    }
  }

  void read_argument(const base::Element& e) {
    check_attributes(e, {}, report_);
    if (is_leaf(e, report_)) {
      module_.arguments.push_back(e.text);
    }
  }

  void read_access(const base::Element& e) {
    check_attributes(e, {}, report_);
    check_no_text(e, report_);
    for (const base::Element& child : e.children) {
      if (child.name != "read" && child.name != "write") {
        report_.error(child.place, "unknown element " + base::in_quotes("<" + child.name + ">") + " in <access>" +
                                       base::suggestion(child.name, {"read", "write"}));
        continue;
      }
      if (const auto text = text_of(child, "knu::Robot::tick", report_)) {
        const bool reads = child.name == "read";
        (reads ? module_.reads : module_.writes).push_back(*text);
        (reads ? module_.places.reads : module_.places.writes).push_back(child.text_place);
      }
    }
  }

  void read_restart(const base::Element& e) {
    check_attributes(e, {"delay", "max", "window", "escalate"}, report_);
    if (is_leaf(e, report_)) {
      check_no_text(e, report_);
    }
    for (const base::Attribute& a : e.attributes) {
      if (a.name == "delay" || a.name == "window") {
        base::DurationText read = base::read_duration(a.value, a.name == "delay");
        if (read.value) {
          auto& duration = a.name == "delay" ? module_.restart.delay : module_.restart.window;
          duration = *read.value;
        } else {
          report_.error(a.value_place, a.name + ": " + read.problem);
        }
      } else if (a.name == "max") {
        constexpr std::int64_t kMaxRestarts = 1'000'000'000;
        if (const auto value = read_integer(a.value, 0, kMaxRestarts)) {
          module_.restart.max = static_cast<std::uint32_t>(*value);
        } else {
          report_.error(a.value_place,
                        "max: " + base::in_quotes(a.value) + " is not a number of restarts; write 0 or more");
        }
      } else if (a.name == "escalate" && a.value == "stop-node") {
        module_.restart.escalate = Restart::Escalate::StopNode;
      } else if (a.name == "escalate" && a.value != "stop-module") {
        report_.error(a.value_place,
                      base::in_quotes(a.value) + " is not a value of escalate; write stop-module or stop-node");
      }
    }
  }

  void read_failsafe(const base::Element& e) {
    check_attributes(e, {"variable"}, report_);
    const bool leaf = is_leaf(e, report_);
    const base::Attribute* variable =
        need_attribute(e, "variable", "<failsafe variable=\"knu::Robot::tick\">0</failsafe>", report_);
    if (!leaf || variable == nullptr) {
      return;
    }
    if (e.text.empty()) {
      report_.error(e.place, "<failsafe> has no value; write the value " + base::in_quotes(variable->value) +
                                 " gets when the module fails");
      return;
    }
    module_.failsafe.push_back({variable->value, e.text, e.place});
  }

  void read_property(const base::Element& e) {
    check_attributes(e, {}, report_);
    check_no_text(e, report_);
    for (const base::Element& child : e.children) {
      if (child.name != "value") {
        report_.error(child.place, "unknown element " + base::in_quotes("<" + child.name + ">") + " in <property>" +
                                       base::suggestion(child.name, {"value"}));
        continue;
      }
      check_attributes(child, {"name"}, report_);
      const bool leaf = is_leaf(child, report_);
      const base::Attribute* name = need_attribute(child, "name", "<value name=\"counter\">5</value>", report_);
      if (!leaf || name == nullptr) {
        continue;
      }
      const bool twice = !property_names_.insert(name->value).second;
      if (twice) {
        report_.error(child.place, "a second property " + base::in_quotes(name->value) + " in this module; remove one");
      } else {
        module_.properties.push_back({name->value, child.text, child.place});
      }
    }
  }

  const base::Element& element_;
  const std::filesystem::path& folder_;
  base::Diagnostics& report_;
  Module module_;
  Given given_;
  std::set<std::string> property_names_;
};

}  // namespace

Module read_module(const base::Element& element, const std::filesystem::path& folder, base::Diagnostics& report) {
  return ModuleReader(element, folder, report).read();
}

}  // namespace indurop::config
