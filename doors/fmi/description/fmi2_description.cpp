// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of FMI 2.0.
#include <fmt/format.h>

#include "doors/fmi/contents/types.h"
#include "doors/fmi/description/xml_parts.h"

namespace indurop::fmi {
namespace {

bool is_real(schema::Base base) {
  return contains(kReals, base);
}

std::string scalar_variable(const ChosenVariable& variable, std::size_t reference) {
  const schema::Type& type = *variable.part.type;
  std::string inner = contains(kEnumerations, type.base) ? attribute("declaredType", type.name) : limits_of(variable);
  if (is_real(type.base)) {
    inner += attribute_if("unit", variable.part.unit);
  }
  if (variable.input) {
    inner += attribute("start", start_of(variable));
  }
  return fmt::format("    <ScalarVariable{}{}{}{}><{}{}/></ScalarVariable>\n", attribute("name", variable.part.name),
                     attribute("valueReference", fmt::format("{}", reference)),
                     attribute_if("description", variable.part.description),
                     variable.input ? R"( causality="input" variability="discrete")"
                                    : R"( causality="output" variability="discrete" initial="calculated")",
                     fmi2_element(type.base), inner);
}

// No output depends on an input at the same time: a module reads it in the next tick.
std::string structure(const Description& description) {
  std::string unknowns;
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    if (!description.variables[i].input) {
      unknowns += fmt::format("      <Unknown index=\"{}\" dependencies=\"\"/>\n", i + 1);
    }
  }
  return unknowns.empty() ? "  <ModelStructure/>\n"
                          : fmt::format(
                                "  <ModelStructure>\n    <Outputs>\n{0}    </Outputs>\n    <InitialUnknowns>\n{0}"
                                "    </InitialUnknowns>\n  </ModelStructure>\n",
                                unknowns);
}

}  // namespace

std::string fmi2_description(const Description& description) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"2.0\"{}{}{} "
      "variableNamingConvention=\"flat\" numberOfEventIndicators=\"0\">\n"
      "  <CoSimulation{} needsExecutionTool=\"true\" canHandleVariableCommunicationStepSize=\"true\" "
      "canNotUseMemoryManagementFunctions=\"true\"/>\n",
      attribute("modelName", description.model), attribute("guid", description.token),
      attribute("generationTool", description.tool), attribute("modelIdentifier", description.identifier));
  text += unit_definitions(description, &is_real);
  std::string types;
  for (const auto& [name, type] : enumerations_of(description)) {
    types += fmt::format("    <SimpleType{}>\n      <Enumeration>\n{}      </Enumeration>\n    </SimpleType>\n",
                         attribute("name", name), items_of(*type));
  }
  text += types.empty() ? "" : fmt::format("  <TypeDefinitions>\n{}  </TypeDefinitions>\n", types);
  text += log_categories() + default_experiment(description) + "  <ModelVariables>\n";
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    text += scalar_variable(description.variables[i], i + 1);
  }
  return text + "  </ModelVariables>\n" + structure(description) + "</fmiModelDescription>\n";
}

}  // namespace indurop::fmi
