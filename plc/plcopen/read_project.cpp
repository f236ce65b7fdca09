// SPDX-License-Identifier: Apache-2.0
#include "plc/plcopen/read_project.h"

#include <utility>

#include "plc/lower/chart.h"
#include "plc/lower/pou.h"

namespace indurop::plc::plcopen {

Project lower(Document& document, const ReadOptions& options, Diagnostics& diagnostics) {
  Project project = std::move(document.project);
  bool charts = false;
  for (PouDocument& each : document.pous) {
    project.pous.push_back(std::move(each.pou));  // all are known before the first is translated
    charts = charts || lower::has_chart(each.code);
  }
  if (charts) {
    project.types.push_back(lower::step_type());
  }
  for (std::size_t i = 0; i < document.pous.size(); ++i) {
    lower::lower_pou(document.pous[i].code, options, project, project.pous[i], diagnostics);
    for (PouDocument& method : document.pous[i].methods) {
      lower::lower_pou(method.code, options, project, method.pou, diagnostics);
      if (method.pou.c_code && !project.pous[i].c_code) {
        project.pous[i].c_code = method.pou.c_code;
      }
      project.pous[i].methods.push_back(std::move(method.pou));
    }
  }
  return project;
}

Project read_project(std::string_view bytes, const std::string& name, const ReadOptions& options,
                     Diagnostics& diagnostics) {
  Document document = read_document(bytes, name, diagnostics);
  return lower(document, options, diagnostics);
}

}  // namespace indurop::plc::plcopen
