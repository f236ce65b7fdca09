// SPDX-License-Identifier: Apache-2.0
// What is no acceptable module.xml is in tests/unit/config/reader_syntax_test.cpp.

#include "core/base/xml.h"

#include <gtest/gtest.h>

#include <random>

namespace indurop::base {
namespace {

XmlRules strict() {
  XmlRules rules{"list.xml", "<list> with entries", "list"};
  rules.max_bytes = 1024 * 1024;
  rules.max_depth = 4;
  return rules;
}
XmlRules tolerant() {
  XmlRules rules = strict();
  rules.tolerant = true;
  return rules;
}

std::string mistakes_in(std::string_view xml, const XmlRules& rules) {
  std::vector<XmlMistake> mistakes;
  const bool read = read_xml(xml, rules, mistakes).has_value();
  EXPECT_EQ(read, mistakes.empty()) << xml;
  std::string out;
  for (const XmlMistake& one : mistakes) {
    out += std::to_string(one.place.line) + ":" + std::to_string(one.place.column) + " " + one.text + "\n";
  }
  return out;
}

Element element(std::string_view xml, const XmlRules& rules) {
  std::vector<XmlMistake> mistakes;
  return read_xml(xml, rules, mistakes).value_or(Element{});
}

TEST(Xml, Places_of_tags_attributes_and_texts_are_known) {
  const Element root = element("<a x=\"1\">\n  <b\n y=\" 2 \">  text </b>\n</a>", strict());
  ASSERT_EQ(root.children.size(), 1U);
  const Element& child = root.children.front();
  EXPECT_EQ(root.attributes.front().value_place, (SourcePlace{1, 7}));
  EXPECT_EQ(child.place, (SourcePlace{2, 3}));
  EXPECT_EQ(child.attributes.front().place, (SourcePlace{3, 2}));
  EXPECT_EQ(child.attributes.front().value, "2");
  EXPECT_EQ(child.text, "text");
  EXPECT_EQ(child.text_place, (SourcePlace{3, 12}));
}

TEST(Xml, Tolerant_reading_keeps_white_space_and_its_place) {
  const Element root = element("<a>\n  <b y=' 2 '>\n  text </b>\n</a>", tolerant());
  ASSERT_EQ(root.children.size(), 1U);
  EXPECT_EQ(root.children.front().attributes.front().value, " 2 ");
  EXPECT_EQ(root.children.front().text, "\n  text ");
  EXPECT_EQ(root.children.front().text_place, (SourcePlace{2, 14}));
  EXPECT_EQ(root.text, "");
}

TEST(Xml, Limits_are_parameters) {
  XmlRules rules = strict();
  rules.max_bytes = 8;
  EXPECT_EQ(mistakes_in("<a></a>  ", rules),
            "0:0 the file is larger than 0 MB; no list needs that, is it the right file?\n");
  EXPECT_EQ(mistakes_in("<a></a> ", rules), "");
  for (const XmlRules& each : {strict(), tolerant()}) {
    EXPECT_EQ(mistakes_in("<a><a><a><a/></a></a></a>", each), "");
    EXPECT_EQ(mistakes_in("<a><a><a><a>\n<a/></a></a></a></a>", each),
              "2:1 elements are nested deeper than 4 levels; no list needs that\n");
  }
  for (XmlRules each : {strict(), tolerant()}) {
    each.max_attributes = 1;
    EXPECT_EQ(mistakes_in("<a b=\"\" c=\"\"/>", each),
              "1:9 more than 1 attributes in one tag; no element has that many\n");
  }
}

TEST(Xml, What_programs_write_is_taken_as_the_library_takes_it) {
  for (const char* xml : {"<!DOCTYPE a>\n<a/>", "<a>&bomb;</a>", "<?xml version=\"1.0\" encoding=\"latin1\"?><a/>",
                          "<a>\xE4</a>", "<a x='<'/>"}) {
    EXPECT_NE(mistakes_in(xml, strict()), "") << xml;
    EXPECT_EQ(mistakes_in(xml, tolerant()), "") << xml;
  }
}

TEST(Xml, A_file_that_is_cut_off_is_distinguished) {
  EXPECT_EQ(mistakes_in("<a>\n<b x=\"1\">\n", tolerant()),
            "2:1 <b> is never closed; add </b>, or is the file cut off?\n");
  EXPECT_EQ(mistakes_in("<a>\n<b></a>\n", tolerant()).substr(0, 23), "2:1 not well-formed XML");
}

TEST(Xml, The_root_of_a_damaged_document_has_a_name) {
  EXPECT_EQ(xml_root_name("\xEF\xBB\xBF<plant><", strict()), "plant");
  EXPECT_EQ(xml_root_name("no", strict()), "");
}

TEST(Xml, Any_bytes_are_an_element_or_mistakes) {
  constexpr std::string_view kPieces[] = {"<a>", "</a>", "<b x=\"1\"/>", "&",  "<!--", "-->", "<![CDATA[",
                                          "]]>", "<?",   "?>",           "\"", " ",    "\n",  "text",
                                          "<!",  ">",    "\xE4",         "\0", "'",    "="};
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same texts in every run
  constexpr int kTexts = 3000;
  for (int i = 0; i < kTexts; ++i) {
    std::string xml = "<a>";
    for (auto pieces = random() % 12; pieces > 0; --pieces) {
      xml += kPieces[random() % std::size(kPieces)];
    }
    (void)mistakes_in(xml, strict());
    (void)mistakes_in(xml, tolerant());
  }
}

}  // namespace
}  // namespace indurop::base
