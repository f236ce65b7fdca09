// SPDX-License-Identifier: Apache-2.0
// The root of module.xml.

#include <algorithm>

#include "deploy/config_reader.h"
#include "deploy/document.h"
#include "deploy/element_rules.h"

namespace indurop::deploy {
namespace {

void interpret(const Element& root, Config& config, Report& report) {
  if (root.name == "plant") {
    report.error(root.place,
                 "this is the manifest of a plant of several boards; run one of them with --board NAME, all of them "
                 "here with --local, or put it to work with indurop deploy");
    return;
  }
  if (root.name != "root") {
    report.error(root.place, "the root element is <" + root.name + ">; a " + kModuleXml.name + " is " +
                                 kModuleXml.form + ", a " + kPlantXml.name + " " + kPlantXml.form);
    return;
  }
  check_root_attributes(root, {}, report);
  read_configuration(root, config, report);
  for (const Module& module : config.modules) {
    if (!module.standby.empty()) {
      report.error(module.places.standby,
                   "<standby> names another board of a plant, and a module.xml is of one board; remove it");
    }
  }
  if (std::none_of(root.children.begin(), root.children.end(), [](const Element& e) { return e.name == "module"; })) {
    report.error(root.place, "<root> has no <module>; add one per program");
  }
}

}  // namespace

void interpret(const Element& root, Config& config, std::vector<Diagnostic>& diagnostics) {
  Report report(config.file.string(), diagnostics);
  interpret(root, config, report);
  sort_by_place(diagnostics);
}

}  // namespace indurop::deploy
