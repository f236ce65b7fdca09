// SPDX-License-Identifier: Apache-2.0
// Rules for the elements that a periodic, sporadic or non-real-time thread or process needs, and those without effect.

#include <initializer_list>

#include "config/xml/module_reader.h"
#include "config/xml/reader.h"

namespace indurop::config {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;

class Rules {
 public:
  Rules(Module& module, const Given& given, base::Diagnostics& report)
      : module_(module), given_(given), report_(report) {}

  void check() {
    require("filename", "this <module>", "./control.so");
    require("moduletype", "this <module>", "thread");
    require("operationtype", "this <module>", "periodic");
    if (given_.type && module_.type == ModuleType::Thread) {
      without_effect({"signal", "argument", "restart"}, "thread");
    }
    if (!given_.operation) {
      return;
    }
    switch (module_.operation) {
      case Operation::Periodic:
        check_periodic();
        break;
      case Operation::Sporadic:
        check_sporadic();
        break;
      case Operation::NonReal:
        check_non_real();
        break;
    }
  }

 private:
  void require(const char* name, const std::string& who, const std::string& example) {
    if (!given_.has(name) && given_.misspelt.find(name) == given_.misspelt.end()) {
      report_.error(module_.place,
                    who + " has no <" + name + ">; add, for example, <" + name + ">" + example + "</" + name + ">");
    }
  }

  void without_effect(std::initializer_list<const char*> names, const std::string& on) {
    for (const char* name : names) {
      if (given_.has(name)) {
        report_.warning(given_.elements.find(name)->second,
                        "<" + std::string(name) + "> has no effect on a " + on + " module; remove it");
      }
    }
  }

  void check_periodic() {
    require("period", "this periodic <module>", "1ms");
    require("priority", "this periodic <module>", "1");
    without_effect({"position"}, "periodic");
    if (module_.period <= base::Nanos::zero()) {
      return;  // reported already
    }
    if (module_.offset >= module_.period) {
      report_.error(module_.places.offset,
                    "the offset " + base::format_duration(module_.offset) + " is not shorter than the period " +
                        base::format_duration(module_.period) + "; write the remainder after whole periods");
      module_.offset = base::Nanos::zero();
    }
    if (module_.deadline > module_.period) {
      report_.warning(module_.places.deadline,
                      "the deadline " + base::format_duration(module_.deadline) + " is longer than the period " +
                          base::format_duration(module_.period) + "; a run that long is an overrun first");
    }
  }

  void check_sporadic() {
    require("deadline", "this sporadic <module>", "1ms");
    require("priority", "this sporadic <module>", "1");
    without_effect({"period", "offset", "after"}, "sporadic");
    module_.after.clear();
    module_.period = base::Nanos::zero();
    module_.offset = base::Nanos::zero();
    if (given_.type && module_.type == ModuleType::Process) {
      without_effect({"position"}, "sporadic process");
      module_.after_base = false;
    } else if (given_.type) {
      without_effect({"core"}, "sporadic thread");
      module_.core = -1;
    }
  }

  void check_non_real() {
    without_effect({"offset", "priority", "deadline", "wcet", "budget", "overrun", "position", "signal", "after"},
                   "non-real-time");
    module_.after.clear();
    module_.offset = base::Nanos::zero();
    module_.deadline = base::Nanos::zero();
    module_.wcet = base::Nanos::zero();
    module_.signal = 0;
    if (given_.type && module_.type == ModuleType::Process) {
      without_effect({"period"}, "non-real-time process");
      module_.period = base::Nanos::zero();
    }
  }

  Module& module_;
  const Given& given_;
  base::Diagnostics& report_;
};

}  // namespace

void check_rules(Module& module, const Given& given, base::Diagnostics& report) {
  Rules(module, given, report).check();
}

}  // namespace indurop::config
