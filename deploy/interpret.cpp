// SPDX-License-Identifier: Apache-2.0
// The root of module.xml, what holds for all modules together, and checks every element needs.

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "deploy/element.h"
#include "deploy/module_reader.h"
#include "deploy/report.h"
#include "deploy/text.h"
#include "deploy/values.h"

namespace indurop::deploy {
namespace {

const std::vector<std::string>& root_elements() {
  static const std::vector<std::string> kNames{"module", "minimum_period", "spin", "core"};
  return kNames;
}

// Editors add these to find the schema; they say nothing to us.
bool is_schema_attribute(const std::string& name) {
  return name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xsi:");
}

class RootReader {
 public:
  RootReader(const Element& root, Config& config, Report& report) : root_(root), config_(config), report_(report) {}

  void read() {
    if (root_.name != "root") {
      report_.error(root_.place, "the root element is <" + root_.name +
                                     ">; a module.xml is <root> with one <module> "
                                     "per program");
      return;
    }
    check_root_attributes();
    check_no_text(root_, report_);
    std::error_code ignored;
    const auto absolute = std::filesystem::absolute(config_.file, ignored);
    folder_ = (ignored ? config_.file : absolute).parent_path();
    for (const Element& child : root_.children) {
      read_child(child);
    }
    if (std::none_of(root_.children.begin(), root_.children.end(),
                     [](const Element& e) { return e.name == "module"; })) {
      report_.error(root_.place, "<root> has no <module>; add one per program");
    }
    name_modules();
  }

 private:
  void check_root_attributes() {
    for (const Attribute& a : root_.attributes) {
      if (!is_schema_attribute(a.name)) {
        report_.error(a.place, "unknown attribute " + in_quotes(a.name) + " of <root>; remove it");
      }
    }
  }

  void read_child(const Element& child) {
    if (child.name == "module") {
      config_.modules.push_back(read_module(child, folder_, report_));
      return;
    }
    if (std::find(root_elements().begin(), root_elements().end(), child.name) == root_elements().end()) {
      report_.error(child.place, "unknown element " + in_quotes("<" + child.name + ">") + " in <root>" +
                                     suggestion(child.name, root_elements()));
      return;
    }
    const auto [first, is_first] = given_.try_emplace(child.name, child.place);
    if (!is_first) {
      report_.error(child.place, "a second <" + child.name + "> in <root>; the first is in line " +
                                     std::to_string(first->second.line) + ", remove one");
      return;
    }
    if (child.name == "core") {
      config_.core_place = child.text_place;
      config_.core = read_core(child, report_);
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

  void read_minimum(const Element& e) {
    DurationText read = read_duration(e.text, false);
    if (read.value) {
      config_.minimum_period = read.value;
    } else {
      report_.error(e.text_place, "<minimum_period>: " + read.problem);
    }
  }

  void read_spin(const Element& e) {
    config_.spin_place = e.text_place;
    if (e.text == "auto" || e.text == "off") {
      config_.spin = SpinSetting{e.text == "auto" ? SpinSetting::Mode::Auto : SpinSetting::Mode::Off, Nanos::zero()};
      return;
    }
    const DurationText read = read_duration(e.text, false);
    if (read.value) {
      config_.spin = SpinSetting{SpinSetting::Mode::Fixed, *read.value};
    } else {
      report_.error(e.text_place, "<spin>: " + (e.text.empty() ? "no value given" : in_quotes(e.text)) +
                                      (e.text.empty() ? "" : " is not possible") +
                                      "; write auto, off or a time such as 20us");
    }
  }

  // A module without <name> is called like its file, "cntr1" for ./cntr1.so as in Table 3; the full file name where
  // that would not tell two modules apart.
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
      const Place place = own ? m.places.name : m.places.file;
      if (m.name.size() >= scheduler::kNameLength) {
        report_.error(place, "the file name is too long for a module name; give this module a short <name>");
        continue;
      }
      const auto [other, is_first] = named.try_emplace(m.name, &m);
      if (!is_first) {
        const bool same_file = other->second->file == m.file;
        report_.error(place, "a second module named " + in_quotes(m.name) + ", the first is in line " +
                                 std::to_string(other->second->place.line) +
                                 (same_file && !own ? "; two modules of one file need different <name>s"
                                                    : "; give one of them another <name>"));
      }
    }
  }

  const Element& root_;
  Config& config_;
  Report& report_;
  std::filesystem::path folder_;
  std::map<std::string, Place> given_;
};

}  // namespace

bool is_leaf(const Element& element, Report& report) {
  if (element.children.empty()) {
    return true;
  }
  report.error(element.children.front().place, "<" + element.name + "> takes a value, not the element " +
                                                   in_quotes("<" + element.children.front().name + ">") + "; is </" +
                                                   element.name + "> missing before it?");
  return false;
}

void check_attributes(const Element& element, const std::vector<std::string>& known, Report& report) {
  for (const Attribute& a : element.attributes) {
    if (std::find(known.begin(), known.end(), a.name) == known.end()) {
      report.error(a.place, "unknown attribute " + in_quotes(a.name) + " of <" + element.name + ">" +
                                (known.empty() ? "; it has none, remove it" : suggestion(a.name, known)));
    }
  }
}

void check_no_text(const Element& container, Report& report) {
  if (!container.text.empty()) {
    report.error(container.text_place, "text " + in_quotes(container.text) + " inside <" + container.name +
                                           ">; values belong into elements, remarks into <!-- -->");
  }
}

int read_core(const Element& element, Report& report) {
  check_attributes(element, {}, report);
  if (!is_leaf(element, report)) {
    return -1;
  }
  constexpr std::int64_t kMostCores = 4096;
  const auto value = read_integer(element.text, 0, kMostCores - 1);
  if (!value) {
    report.error(element.text_place,
                 "<core>: " + in_quotes(element.text) + " is not a processor number; write 0 for the first");
    return -1;
  }
  return static_cast<int>(*value);
}

void interpret(const Element& root, Config& config, std::vector<Diagnostic>& diagnostics) {
  Report report(config.file.string(), diagnostics);
  RootReader(root, config, report).read();
  const auto key = [](const Diagnostic& d) {
    return std::pair(d.place.line == 0 ? std::numeric_limits<int>::max() : d.place.line, d.place.column);
  };
  std::stable_sort(diagnostics.begin(), diagnostics.end(),
                   [key](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
}

}  // namespace indurop::deploy
