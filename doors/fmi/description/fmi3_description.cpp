// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of FMI 3.0.
#include <fmt/format.h>

#include <algorithm>

#include "doors/fmi/contents/types.h"
#include "doors/fmi/description/xml_parts.h"

namespace indurop::fmi {
namespace {

bool is_float(schema::Base base) {
  return contains(set_of(schema::Base::Float, schema::Base::Double), base);
}

std::string variable3(const ChosenVariable& variable, std::size_t reference) {
  const schema::Type& type = *variable.part.type;
  const char* const element = fmi3_element(type.base);
  std::string text = fmt::format(
      "    <{}{}{}{}{}{}", element, attribute("name", variable.part.name),
      attribute("valueReference", fmt::format("{}", reference)), attribute_if("description", variable.part.description),
      variable.input ? R"( causality="input" variability="discrete")"
                     : R"( causality="output" variability="discrete" initial="calculated")",
      contains(kEnumerations, type.base) ? attribute("declaredType", type.name) : limits_of(variable));
  if (is_float(type.base)) {
    text += attribute_if("unit", variable.part.unit);
  }
  if (!variable.input) {
    return text + "/>\n";
  }
  const std::string start = start_of(variable);
  return type.base == schema::Base::Text ? text + fmt::format("><Start{}/></{}>\n", attribute("value", start), element)
                                         : text + attribute("start", start) + "/>\n";
}

// Every FMU has the time as a variable, whose name no other one must have.
std::string time_variable(const Description& description) {
  std::string name = "time";
  while (std::any_of(description.variables.begin(), description.variables.end(),
                     [&name](const ChosenVariable& one) { return one.part.name == name; })) {
    name += '_';
  }
  return fmt::format("    <Float64{} valueReference=\"0\" causality=\"independent\" variability=\"continuous\"/>\n",
                     attribute("name", name));
}

}  // namespace

std::string fmi3_description(const Description& description) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"3.0\"{}{}{} "
      "variableNamingConvention=\"flat\">\n"
      "  <CoSimulation{} needsExecutionTool=\"true\" canHandleVariableCommunicationStepSize=\"true\" "
      "fixedInternalStepSize=\"{}\"/>\n",
      attribute("modelName", description.model), attribute("instantiationToken", description.token),
      attribute("generationTool", description.tool), attribute("modelIdentifier", description.identifier),
      description.period_s);
  text += unit_definitions(description, &is_float);
  std::string types;
  for (const auto& [name, type] : enumerations_of(description)) {
    types +=
        fmt::format("    <EnumerationType{}>\n{}    </EnumerationType>\n", attribute("name", name), items_of(*type));
  }
  text += types.empty() ? "" : fmt::format("  <TypeDefinitions>\n{}  </TypeDefinitions>\n", types);
  text += log_categories() + default_experiment(description) + "  <ModelVariables>\n" + time_variable(description);
  std::string outputs;
  std::string unknowns;
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    text += variable3(description.variables[i], i + 1);
    if (!description.variables[i].input) {
      outputs += fmt::format("    <Output valueReference=\"{}\" dependencies=\"\"/>\n", i + 1);
      unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\" dependencies=\"\"/>\n", i + 1);
    }
  }
  return text + "  </ModelVariables>\n  <ModelStructure>\n" + outputs + unknowns +
         "  </ModelStructure>\n</fmiModelDescription>\n";
}

}  // namespace indurop::fmi
