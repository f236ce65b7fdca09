// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of FMI 2.0 and 3.0: what it says, what is wrong with it. The samples are written by hand.
#include "control/io/fmu/description.h"

#include <gmock/gmock.h>

#include <random>

#include "core/base/read_file.h"

namespace indurop::io::fmu {
namespace {

using ::testing::ElementsAre;

std::string sample(int version) {
  return base::read_file(std::string(LAG) + "/lag" + std::to_string(version) + ".xml").value();
}

Description described(const std::string& xml) {
  ReadDescription read = read_description(xml, "x.xml");
  EXPECT_EQ(base::to_text(read.diagnostics), "");
  return std::move(read.description);
}

// Not a string: GCC 14 would believe that the reference is to it.
const Variable& variable(const Description& description, const char* name) {
  return description.variables.at(description.by_name.at(name));
}

TEST(FmuDescription, Says_what_both_versions_say) {
  for (const int version : {2, 3}) {
    const Description sut = described(sample(version));
    EXPECT_EQ(sut.version, version == 2 ? Version::Fmi2 : Version::Fmi3);
    EXPECT_EQ(sut.model, "lag");
    EXPECT_EQ(sut.identifier, "lag");
    EXPECT_EQ(sut.token, "{1f2b8e60-lag}");
    EXPECT_TRUE(sut.any_step);
    EXPECT_THAT(sut.log_categories, ElementsAre("events", "logStatusError", "logStatusWarning"));
    const Variable& u = variable(sut, "u");
    EXPECT_EQ(u.reference, 1U);
    EXPECT_EQ(u.type, Type::Float64);
    EXPECT_EQ(u.causality, Causality::Input);
    EXPECT_EQ(u.variability, Variability::Continuous);
    EXPECT_EQ(u.unit, "mm") << "of its declared type";
    EXPECT_EQ(u.min, -10);
    EXPECT_EQ(u.max, 10);
    EXPECT_EQ(u.description, "Set point");
    EXPECT_EQ(variable(sut, "steps").type, Type::Int32);
    EXPECT_EQ(variable(sut, "gain").variability, Variability::Tunable);
    EXPECT_EQ(variable(sut, "choice").items.size(), 2U);
    EXPECT_EQ(read_number(variable(sut, "choice"), "slow run"), 1);
    EXPECT_EQ(read_number(variable(sut, "choice"), "medium"), std::nullopt);
    EXPECT_EQ(read_number(variable(sut, "flag"), "true"), 1);
    EXPECT_EQ(read_number(variable(sut, "steps"), "2147483648"), std::nullopt);
  }
}

TEST(FmuDescription, Arrays_have_elements_and_variables_other_names) {
  const Description sut = described(sample(3));
  EXPECT_THAT(variable(sut, "vector").dims, ElementsAre(2, 3)) << "one of them is a structural parameter";
  EXPECT_EQ(element_name(variable(sut, "vector"), 4), "vector[2,2]");
  EXPECT_EQ(find_place(sut, "vector[2,2]")->element, 4U);
  EXPECT_TRUE(find_place(sut, "vector")->is_whole);
  for (const char* none : {"vector[3,1]", "vector[0,1]", "vector[1]", "vector[1,2,3]", "vector[1,]", "vector[", "u[1]",
                           "nothing", "", "]", "vector[18446744073709551617,1]"}) {
    EXPECT_FALSE(find_place(sut, none)) << none;
  }
  EXPECT_EQ(variable(sut, "position").reference, variable(sut, "lag.y").reference);
  EXPECT_EQ(read_numbers(variable(sut, "vector"), "1 2 3 4 5 6").size(), 6U);
  EXPECT_EQ(read_numbers(variable(sut, "vector"), "1").size(), 1U);
  EXPECT_TRUE(read_numbers(variable(sut, "vector"), "1 2").empty());
}

std::string errors_of(const std::string& xml) {
  return base::to_text(read_description(xml, "x.xml").diagnostics);
}

std::string fmi3(const std::string& inside, const std::string& root = R"(fmiVersion="3.0" instantiationToken="t")") {
  return "<fmiModelDescription " + root + ">" + inside + "</fmiModelDescription>";
}

TEST(FmuDescription, Says_what_is_wrong_and_what_to_do) {
  const std::string kind = R"(<CoSimulation modelIdentifier="m"/>)";
  EXPECT_EQ(errors_of("<a/>"),
            "x.xml:1:1: error: the root element is <a>, not <fmiModelDescription>: this is no FMU\n");
  EXPECT_EQ(errors_of(fmi3("", R"(fmiVersion="1.0")")),
            "x.xml:1:1: error: the FMU is of FMI 1.0; export it with FMI 2.0 or 3.0\n");
  EXPECT_EQ(errors_of(fmi3(R"(<ModelExchange modelIdentifier="m"/>)")),
            "x.xml:1:1: error: the FMU is for model exchange only; export it for co-simulation, with its own solver\n");
  EXPECT_EQ(errors_of(fmi3(kind)),
            "x.xml:1:1: error: there is no <ModelVariables>; the FMU is damaged, export it again\n");
  EXPECT_EQ(errors_of(fmi3(kind + "<ModelVariables>\n<Float64 valueReference=\"x\" causality=\"in\"/>\n<Float63/>\n"
                                  "</ModelVariables>")),
            "x.xml:2:1: error: <Float64> has no name; the FMU is damaged, export it again\n"
            "x.xml:2:1: error: valueReference: 'x' is no 32-bit number; export the FMU again\n"
            "x.xml:2:1: error: causality: 'in' is not known; export the FMU again\n"
            "x.xml:3:1: error: <Float63> is no type of FMI 3.0; export the FMU again\n");
  EXPECT_EQ(
      errors_of(fmi3(kind + R"(<ModelVariables><Float64 name="x" valueReference="1"><Dimension start="9999999999"/>)"
                            R"(</Float64></ModelVariables>)")),
      "x.xml:1:150: error: the dimension of 'x' is no size of at most 1000000 elements together\n");
  EXPECT_NE(errors_of(R"(<fmiModelDescription fmiVersion="2.0" guid="g"><CoSimulation modelIdentifier="../m"/>)"
                      "<ModelVariables/></fmiModelDescription>"),
            "");
  EXPECT_NE(errors_of("<fmiModelDescription"), "");
  EXPECT_NE(errors_of(""), "");
}

TEST(FmuDescription, Any_bytes_are_read) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same texts in every run
  for (int i = 0; i < 4000; ++i) {
    std::string xml = sample(i % 2 == 0 ? 2 : 3);
    for (std::size_t k = 0; k < 1 + random() % 6; ++k) {
      const std::size_t at = random() % xml.size();
      if (random() % 3 == 0) {
        xml.erase(at, random() % 40);
      } else if (random() % 2 == 0) {
        xml.insert(at, xml.substr(random() % xml.size(), random() % 200));
      } else {
        xml[at] = static_cast<char>(random());
      }
    }
    const ReadDescription read = read_description(xml, "x.xml");
    for (const Variable& one : read.description.variables) {
      const auto place = find_place(read.description, element_name(one, 0));
      EXPECT_TRUE(base::has_error(read.diagnostics) || one.size() == 0 || place) << xml;
      (void)read_numbers(one, one.start.empty() ? "" : one.start.front());
    }
  }
}

}  // namespace
}  // namespace indurop::io::fmu
