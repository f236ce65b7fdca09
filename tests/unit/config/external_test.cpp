// SPDX-License-Identifier: Apache-2.0
// What XML files say about topics for tools of others.
#include <gmock/gmock.h>

#include <string>

#include "config/check/check_parts.h"
#include "config/xml/plant_reader.h"
#include "config/xml/reader.h"

namespace indurop::config {
namespace {

using External = VariableRule::External;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ReadResult read_root(const std::string& inside) {
  return read_config_text("<root>" + inside +
                              "<module><filename>./a.so</filename><moduletype>thread</moduletype><operationtype>"
                              "periodic</operationtype><period>1ms</period><priority>1</priority></module></root>",
                          "/cell/m.xml");
}
ReadPlant read_board(const std::string& inside) {
  return read_plant_text("<plant name=\"p\">" + inside + "<board name=\"a\"/></plant>", "/cell/p.xml");
}
template <class Read>
std::vector<std::string> said(const Read& read) {
  std::vector<std::string> texts;
  for (const base::Diagnostic& diagnostic : read.diagnostics) {
    if (diagnostic.severity != base::Diagnostic::Severity::Note) {
      texts.push_back(diagnostic.text);
    }
  }
  return texts;
}

TEST(External, Of_a_module_xml_is_read) {
  const ReadResult sut = read_root(
      "<external interface=\"eth1\">3</external><types>./libt.so</types><types>/opt/libu.so</types>"
      "<variable name=\"a::b\" external=\"write\" every=\"20ms\"/><variable name=\"a::c\" external=\"off\"/>");
  EXPECT_THAT(said(sut), IsEmpty());
  const ExternalPlane& plane = sut.config.external;
  EXPECT_EQ(plane.domain, 3);
  EXPECT_EQ(plane.interface_name, "eth1");
  EXPECT_THAT(plane.types, ElementsAre("/cell/libt.so", "/opt/libu.so"));
  ASSERT_EQ(plane.variables.size(), 2U);
  EXPECT_EQ(plane.variables[0].external, External::Write);
  EXPECT_EQ(plane.variables[0].every, std::chrono::milliseconds(20));
  EXPECT_EQ(plane.variables[1].external, External::Off);
}

TEST(External, Of_a_module_xml_is_off_without_types_and_domain_0_with_them) {
  EXPECT_FALSE(read_root("").config.external.domain);
  EXPECT_EQ(read_root("<types>./libt.so</types>").config.external.domain, 0);
  EXPECT_FALSE(read_root("<external>off</external><types>./libt.so</types>").config.external.domain);
}

TEST(External, Errors_in_a_module_xml_are_reported) {
  EXPECT_THAT(said(read_root("<external>2</external>")), ElementsAre(HasSubstr("shows nothing without <types>")));
  EXPECT_THAT(said(read_root("<external>300</external><types>./t.so</types>")),
              ElementsAre(HasSubstr("is not a DDS domain")));
  EXPECT_THAT(said(read_root("<external/><types>./t.so</types>")), ElementsAre(HasSubstr("has no value")));
  EXPECT_THAT(said(read_root("<external>1</external><external>2</external><types>./t.so</types>")),
              ElementsAre(HasSubstr("a second <external>")));
  EXPECT_THAT(said(read_root("<variable name=\"a\" external=\"writ\"/>")),
              ElementsAre(HasSubstr("'writ' is not a value of external; write read, write")));
  EXPECT_THAT(said(read_root("<variable name=\"a\" owner=\"b\"/>")),
              ElementsAre(HasSubstr("unknown attribute 'owner'")));
  EXPECT_THAT(said(read_root("<variable name=\"a\"/>")), ElementsAre(HasSubstr("give it every or external")));
}

TEST(External, Names_of_ROS_2_are_asked_for) {
  EXPECT_FALSE(read_root("<external>2</external><types>./t.so</types>").config.external.ros2);
  EXPECT_TRUE(read_root("<external ros2=\"on\">2</external><types>./t.so</types>").config.external.ros2);
  EXPECT_THAT(said(read_root("<external ros2=\"yes\">2</external><types>./t.so</types>")),
              ElementsAre(HasSubstr("'yes' is not a value of ros2; write on or off")));
  const std::string board = "<board name=\"a\"></board>";
  EXPECT_TRUE(read_plant_text("<plant name=\"p\"><external ros2=\"on\">2</external>" + board + "</plant>", "p.xml")
                  .plant.external_ros2);
}

TEST(External, Of_a_board_is_said_by_its_plant) {
  const ReadPlant sut =
      read_plant_text("<plant name=\"p\"><board name=\"a\"><types>./t.so</types></board></plant>", "/cell/p.xml");
  EXPECT_THAT(said(sut), ElementsAre(HasSubstr("unknown element '<types>' in <board>")));
}

TEST(External, Of_a_plant_knows_what_tools_may_do_with_a_variable) {
  const ReadPlant sut = read_board(
      "<types>./t.so</types><variable name=\"a::b\" external=\"write\"/><variable name=\"a::c\" every=\"1s\"/>");
  EXPECT_THAT(said(sut), IsEmpty());
  ASSERT_EQ(sut.plant.variables.size(), 2U);
  EXPECT_EQ(sut.plant.variables[0].external, External::Write);
  EXPECT_EQ(sut.plant.variables[1].external, External::Read);
}

TEST(External, Of_a_secured_plant_is_off_unless_it_is_asked_for) {
  const std::string secured = "<security>keys</security><types>./t.so</types>";
  EXPECT_FALSE(read_board(secured).plant.external_domain);
  const ReadPlant sut = read_board(secured + "<external>0</external>");
  EXPECT_EQ(sut.plant.external_domain, 0);
  EXPECT_THAT(said(sut), ElementsAre(HasSubstr("the boards are secured, this domain is not")));
  const ReadPlant closed = read_board(secured + "<external secure=\"on\">0</external>");
  EXPECT_TRUE(closed.plant.external_secure);
  EXPECT_THAT(said(closed), IsEmpty());
  EXPECT_THAT(said(read_board("<external secure=\"on\">0</external>")),
              ElementsAre(HasSubstr("secure=\"on\" needs keys of the plant")));
}

TEST(External, Arrays_of_texts_are_named_because_Debians_fastddsgen_misreads_them) {
  const auto text = [](std::vector<std::uint32_t> dims) {
    schema::Type type;
    type.base = schema::Base::Text;
    type.text_size = type.element_size = 16;
    type.dims = std::move(dims);
    return type;
  };
  const auto variable = [](const std::string& name, schema::Type type) {
    schema::Variable made;
    made.name = name;
    made.type = std::move(type);
    return made;
  };
  schema::Type inside;
  inside.base = schema::Base::Struct;
  inside.fields.resize(1);
  inside.fields[0].type = text({3});
  schema::Schema schema;
  schema.variables = {variable("a::names", text({3})), variable("a::one", text({})), variable("a::deep", inside),
                      variable("a::hidden", text({2}))};
  VariableRule off;
  off.name = "a::hidden";
  off.external = External::Off;
  TypeFiles types;
  types.types = {"/cell/libt.so"};
  types.type_places = {{3, 5}};
  std::vector<base::Diagnostic> said;
  base::Diagnostics report("m.xml", said);
  check_foreign_types(types, {off}, schema, report);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(base::to_string(said[0]), HasSubstr("m.xml:3:5: note: arrays of texts are misread by programs made with "
                                                  "fastddsgen 2.3 (Debian 12)"));
  EXPECT_THAT(said[0].text, HasSubstr("a::names and a::deep;"));
  check_foreign_types({}, {}, schema, report);
  EXPECT_EQ(said.size(), 1U) << "nothing is shown";
}

}  // namespace
}  // namespace indurop::config
