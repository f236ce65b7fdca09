// SPDX-License-Identifier: Apache-2.0
// The root of module.xml.

#include "config/xml/interpret.h"

#include <algorithm>

#include "config/xml/config_reader.h"
#include "config/xml/document.h"
#include "config/xml/element_rules.h"

namespace indurop::config {
namespace {

void interpret(const base::Element& root, config::Config& config, base::Diagnostics& report) {
  if (root.name == "plant") {
    report.error(root.place,
                 "this is the manifest of a plant of several boards; run one of them with --board NAME, all of them "
                 "here with --local, or deploy it with indurop deploy");
    return;
  }
  if (root.name != "root") {
    report.error(root.place, "the root element is <" + root.name + ">; a " + kModuleXml.name + " is " +
                                 kModuleXml.form + ", a " + kPlantXml.name + " " + kPlantXml.form);
    return;
  }
  check_root_attributes(root, {}, report);
  read_configuration(root, config, report);
  for (const config::Module& module : config.modules) {
    if (!module.standby.empty()) {
      report.error(module.places.standby,
                   "<standby> names another board of a plant, and a module.xml is of one board; remove it");
    }
  }
  if (std::none_of(root.children.begin(), root.children.end(),
                   [](const base::Element& e) { return e.name == "module"; })) {
    report.error(root.place, "<root> has no <module>; add one per program");
  }
}

}  // namespace

void interpret(const base::Element& root, config::Config& config, std::vector<base::Diagnostic>& diagnostics) {
  base::Diagnostics report(config.file.string(), diagnostics);
  interpret(root, config, report);
  report.add_summary(diagnostics);
  base::sort_by_place(diagnostics);
}

}  // namespace indurop::config
