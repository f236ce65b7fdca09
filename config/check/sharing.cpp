// SPDX-License-Identifier: Apache-2.0
// Determines which modules must keep their order, because data flows between them or <after> requires it. All others
// may run in parallel on several cores.

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/check/access_map.h"
#include "config/check/check_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

class Finder {
 public:
  explicit Finder(const CheckContext& context)
      : config_(context.config), result_(context.result), position_(config_.modules.size()) {
    order_ = execution_order(result_);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      position_[order_[i]] = i;
    }
    for (std::size_t i = 0; i < config_.modules.size(); ++i) {
      by_name_.emplace(config_.modules[i].name, i);
    }
  }

  std::vector<Sharing> find() {
    for (const VariableUse& use : result_.uses) {
      add_variable(use);
    }
    add_unknown();
    add_functions();
    for (std::size_t i = 0; i < config_.modules.size(); ++i) {
      for (const std::string& earlier : config_.modules[i].after) {
        add(by_name_.at(earlier), i, "<after>");
      }
    }
    std::vector<Sharing> all;
    for (const auto& [places, reasons] : pairs_) {
      constexpr std::size_t kMaxShown = 3;
      all.push_back({order_[places.first], order_[places.second],
                     base::enumerate(std::vector<std::string>(reasons.begin(), reasons.end()), kMaxShown)});
    }
    return all;
  }

 private:
  [[nodiscard]] bool timed(std::size_t module) const {
    return config_.modules[module].operation != scheduler::Operation::NonReal;
  }

  void add(std::size_t a, std::size_t b, const std::string& why) {
    if (a != b && timed(a) && timed(b)) {
      pairs_[std::minmax(position_[a], position_[b])].insert(why);
    }
  }

  void add_variable(const VariableUse& use) {
    for (const std::string& writer : use.writers) {
      const std::size_t from = by_name_.at(writer);
      users_.insert(from);
      for (const auto* others : {&use.readers, &use.writers}) {
        for (const std::string& other : *others) {
          add(from, by_name_.at(other), use.name);
        }
      }
    }
    for (const std::string& reader : use.readers) {
      users_.insert(by_name_.at(reader));
    }
  }

  // The accesses of such a module are unknown: it may share data with any other.
  [[nodiscard]] bool unreadable(std::size_t module) const {
    std::error_code ignored;
    return result_.facts[module].file.machine == 0 && (config_.modules[module].type == scheduler::ModuleType::Thread ||
                                                       !std::filesystem::exists(config_.modules[module].file, ignored));
  }

  void add_unknown() {
    for (std::size_t i = 0; i < result_.facts.size(); ++i) {
      if (unreadable(i)) {
        for (const std::size_t other : order_) {
          add(i, other, "what " + config_.modules[i].name + " uses is not known: its file cannot be read");
        }
      }
    }
    std::set<std::size_t> by_computed_names(result_.unknown_readers.begin(), result_.unknown_readers.end());
    by_computed_names.insert(result_.unknown_writers.begin(), result_.unknown_writers.end());
    users_.insert(by_computed_names.begin(), by_computed_names.end());
    for (const std::size_t module : by_computed_names) {
      for (const std::size_t other : users_) {
        add(module, other, "names known only at run time (channel) in " + config_.modules[module].name);
      }
    }
  }

  // A module's file does not list whose functions it calls.
  void add_functions() {
    const auto imports = [&](std::size_t module, const char* symbol) {
      const auto& names = result_.facts[module].file.imports;
      return std::find(names.begin(), names.end(), symbol) != names.end();
    };
    for (std::size_t i = 0; i < result_.facts.size(); ++i) {
      for (std::size_t k = 0; imports(i, "indurop_offer_function") && k < result_.facts.size(); ++k) {
        if (imports(k, "indurop_call")) {
          add(i, k, "shared functions");
        }
      }
    }
  }

  const Config& config_;
  const CheckResult& result_;
  std::vector<std::size_t> order_;
  std::vector<std::size_t> position_;  // by module
  std::map<std::string, std::size_t> by_name_;
  std::set<std::size_t> users_;  // modules with a variable
  std::map<std::pair<std::size_t, std::size_t>, std::set<std::string>> pairs_;
};

}  // namespace

bool uses_several_cores(const Config& config) {
  const auto timed = [](const Module& module) { return module.operation != scheduler::Operation::NonReal; };
  const auto core_of = [&](const Module& module) { return module.core >= 0 ? module.core : config.core; };
  const auto first = std::find_if(config.modules.begin(), config.modules.end(), timed);
  return config.cores || std::any_of(first, config.modules.end(), [&](const Module& module) {
           return timed(module) && core_of(module) != core_of(*first);
         });
}

void find_sharing(CheckContext& context) {
  context.result.sharing = Finder(context).find();
}

}  // namespace indurop::config
