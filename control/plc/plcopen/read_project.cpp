// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/read_project.h"

#include <utility>

#include "control/plc/plcopen/document.h"

namespace indurop::plc::plcopen {

Project read_project(std::string_view bytes, const std::string& name, std::vector<st::WrittenBody>& bodies,
                     Diagnostics& diagnostics) {
  Document document = read_document(bytes, name, diagnostics);
  Project project = std::move(document.project);
  for (PouDocument& each : document.pous) {
    const std::size_t number = project.pous.size();
    ast::Pou& pou = project.pous.emplace_back(std::move(each.pou));
    bodies.push_back({number, std::nullopt, std::move(each.code)});
    for (PouDocument& method : each.methods) {
      bodies.push_back({number, pou.methods.size(), std::move(method.code)});
      pou.methods.push_back(std::move(method.pou));
    }
  }
  return project;
}

}  // namespace indurop::plc::plcopen
