// SPDX-License-Identifier: Apache-2.0
#include "config/xml/config_reader.h"

#include <algorithm>
#include <map>

#include "config/xml/after_rules.h"
#include "config/xml/element_rules.h"
#include "config/xml/external_reader.h"
#include "config/xml/module_reader.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

class ConfigReader {
 public:
  ConfigReader(const base::Element& container, Config& config, base::Diagnostics& report)
      : container_(container),
        config_(config),
        report_(report),
        folder_(config::folder_of(config.file)),
        external_(config.external, folder_, report) {}

  void read() {
    check_no_text(container_, report_);
    for (const base::Element& child : container_.children) {
      read_child(child);
    }
    external_.end();
    name_modules();
    check_after(config_, report_);
  }

 private:
  void read_child(const base::Element& child) {
    static const std::vector<std::string> kBoardNames{"module", "minimum_period", "spin", "core", "cores", "order"};
    static const std::vector<std::string> kRootNames{"module", "minimum_period", "spin",  "core",    "cores",
                                                     "order",  "external",       "types", "variable"};
    const std::vector<std::string>& names = container_.name == "root" ? kRootNames : kBoardNames;
    if (child.name == "module") {
      config_.modules.push_back(read_module(child, folder_, report_));
      return;
    }
    if (!is_known(child, container_, names, report_) || external_.read(child) ||
        !is_first(child, "this <" + container_.name + ">", given_, report_)) {
      return;
    }
    if (child.name == "core") {
      config_.core_place = child.text_place;
      config_.core = read_core(child, report_);
      return;
    }
    if (child.name == "cores") {
      read_cores(child);
      return;
    }
    if (child.name == "order") {
      if (const auto word = choose(child, {"data", "total"}, report_)) {
        config_.order = *word == 0 ? scheduler::CoreOrder::Data : scheduler::CoreOrder::Total;
      }
      return;
    }
    check_attributes(child, {}, report_);
    if (!is_leaf(child, report_)) {
      return;
    }
    if (child.name == "spin") {
      read_spin(child);
    } else {
      read_minimum(child);
    }
  }

  void read_cores(const base::Element& e) {
    check_attributes(e, {"sharing", "times"}, report_);
    if (!is_leaf(e, report_)) {
      return;
    }
    CoresSetting cores;
    cores.place = e.text_place;
    const auto most = e.text == "auto" ? std::optional<std::int64_t>(0) : read_integer(e.text, 1, kMaxSpreadCores);
    if (!most) {
      report_.error(e.text_place,
                    "<cores>: " + (e.text.empty() ? "no value given" : base::in_quotes(e.text) + " is not possible") +
                        "; write auto, or how many cores from 1 to " + std::to_string(kMaxSpreadCores));
      return;
    }
    cores.most = static_cast<int>(*most);
    if (const base::Attribute* times = find_attribute(e, "times"); times != nullptr && !times->value.empty()) {
      cores.times = (folder_ / times->value).lexically_normal();
    }
    if (const base::Attribute* sharing = find_attribute(e, "sharing"); sharing != nullptr) {
      cores.split_sharing = sharing->value == "split";
      if (!cores.split_sharing && sharing->value != "together") {
        report_.error(sharing->value_place,
                      base::in_quotes(sharing->value) + " is not a value of sharing; write together or split");
      }
    }
    config_.cores = cores;
  }

  void read_minimum(const base::Element& e) {
    base::DurationText read = base::read_duration(e.text, false);
    if (read.value) {
      config_.minimum_period = read.value;
    } else {
      report_.error(e.text_place, "<minimum_period>: " + read.problem);
    }
  }

  void read_spin(const base::Element& e) {
    config_.spin_place = e.text_place;
    if (e.text == "auto" || e.text == "off") {
      config_.spin =
          SpinSetting{e.text == "auto" ? SpinSetting::Mode::Auto : SpinSetting::Mode::Off, base::Nanos::zero()};
      return;
    }
    const base::DurationText read = base::read_duration(e.text, false);
    if (read.value) {
      config_.spin = SpinSetting{SpinSetting::Mode::Fixed, *read.value};
    } else {
      report_.error(e.text_place, "<spin>: " + (e.text.empty() ? "no value given" : base::in_quotes(e.text)) +
                                      (e.text.empty() ? "" : " is not possible") +
                                      "; write auto, off or a time such as 20us");
    }
  }

  // A module without <name> is named after its file, "cntr1" for ./cntr1.so as in Table 3; the full file name is used
  // where two modules would have the same name.
  void name_modules() {
    std::map<std::string, int> stems;
    for (const Module& m : config_.modules) {
      ++stems[m.name.empty() ? m.file.stem().string() : m.name];
    }
    std::map<std::string, const Module*> named;
    for (Module& m : config_.modules) {
      const bool own = !m.name.empty();
      if (!own) {
        if (m.file.empty()) {
          continue;  // reported already
        }
        const std::string stem = m.file.stem().string();
        m.name = stems[stem] > 1 ? m.file.filename().string() : stem;
      }
      const base::SourcePlace place = own ? m.places.name : m.places.file;
      if (m.name.size() >= scheduler::kNameLength) {
        report_.error(place, "the file name is too long for a module name; give this module a short <name>");
        continue;
      }
      const auto [other, is_first] = named.try_emplace(m.name, &m);
      if (!is_first) {
        const bool same_file = other->second->file == m.file;
        report_.error(place, "a second module named " + base::in_quotes(m.name) + ", the first is in line " +
                                 std::to_string(other->second->place.line) +
                                 (same_file && !own ? "; two modules of one file need different <name>s"
                                                    : "; give one of them another <name>"));
      }
    }
  }

  const base::Element& container_;
  Config& config_;
  base::Diagnostics& report_;
  std::filesystem::path folder_;
  ExternalReader external_;
  FirstPlaces given_;
};

}  // namespace

void read_configuration(const base::Element& container, Config& config, base::Diagnostics& report) {
  ConfigReader(container, config, report).read();
}

std::filesystem::path folder_of(const std::filesystem::path& xml_file) {
  std::error_code ignored;
  const auto absolute = std::filesystem::absolute(xml_file, ignored);
  return (ignored ? xml_file : absolute).parent_path();
}

}  // namespace indurop::config
