// SPDX-License-Identifier: Apache-2.0
// After which contacts and coils a running view derives the power: only where nothing can have changed them
// since.

#include "control/plc/lower/derived_power.h"

#include <gtest/gtest.h>

#include <set>

namespace indurop::plc {
namespace {

using network::Element;
using Kind = Element::Kind;

Element element(Kind kind, std::uint64_t id, const std::string& text, const std::vector<std::uint64_t>& from) {
  Element made;
  made.kind = kind;
  made.id = id;
  made.text = text;
  made.y = 0;
  made.x = static_cast<int>(id);
  if (!from.empty()) {
    auto& pin = made.inputs.emplace_back();
    for (const std::uint64_t one : from) {
      pin.connections.push_back({{}, one, "", {}});
    }
  }
  return made;
}

// A rung of contacts and coils in a row; with `more` after the last of them.
std::set<std::string> derived(const std::vector<std::pair<Kind, std::string>>& row,
                              const std::vector<Element>& more = {}) {
  network::Body body;
  body.language = network::Body::Language::Ld;
  auto& elements = body.diagram.elements;
  elements.push_back(element(Kind::LeftRail, 1, "", {}));
  for (const auto& [kind, text] : row) {
    elements.push_back(element(kind, elements.size() + 1, text, {elements.size()}));
  }
  elements.insert(elements.end(), more.begin(), more.end());
  Diagnostics diagnostics;
  const network::Sheet sheet = network::make_sheet(body, "POU p", diagnostics);
  std::set<std::string> out;
  for (const Element* one : lower::derived_power(sheet)) {
    out.insert(one->text);
  }
  return out;
}

using Names = std::set<std::string>;

TEST(PlcDerivedPower, Contacts_and_coils_in_a_row) {
  EXPECT_EQ(derived({{Kind::Contact, "a"}, {Kind::Contact, "b.c"}, {Kind::Coil, "d"}}), (Names{"a", "b.c", "d"}));
}

TEST(PlcDerivedPower, A_contact_of_a_variable_that_the_rung_writes_is_reported) {
  EXPECT_EQ(derived({{Kind::Contact, "Motor"}, {Kind::Coil, "motor"}}), Names{"motor"}) << "the coil only";
  EXPECT_EQ(derived({{Kind::Contact, "axes[i].on"}, {Kind::Coil, "i"}}), Names{"i"}) << "another element";
  EXPECT_EQ(derived({{Kind::Contact, "%MX0.1"}, {Kind::Coil, "%MW0"}}), Names{"%MW0"}) << "addresses lie in each other";
}

TEST(PlcDerivedPower, What_calls_a_function_is_reported) {
  EXPECT_EQ(derived({{Kind::Contact, "count(n) > 3"}, {Kind::Coil, "d"}}), Names{"d"});
}

TEST(PlcDerivedPower, Next_to_a_block_of_the_user_every_contact_is_reported) {
  Element block = element(Kind::Block, 9, "", {2});
  block.type = "TON";
  block.instance = "t";
  block.inputs.front().name = "IN";
  EXPECT_EQ(derived({{Kind::Contact, "a"}, {Kind::Contact, "t.Q"}}, {block}), Names{"a"}) << "the timer writes t.Q";
  block.type = "Motor";
  EXPECT_EQ(derived({{Kind::Contact, "a"}, {Kind::Contact, "t.Q"}}, {block}), Names{});
}

TEST(PlcDerivedPower, Nothing_is_derived_where_networks_are_jumped_over) {
  EXPECT_EQ(derived({{Kind::Contact, "a"}, {Kind::Coil, "d"}}, {element(Kind::Return, 9, "", {2})}), Names{});
}

TEST(PlcDerivedPower, After_an_edge_or_a_block_it_is_reported) {
  Element edge = element(Kind::Contact, 9, "b", {2});
  edge.edge = ast::Edge::Rising;
  EXPECT_EQ(derived({{Kind::Contact, "a"}}, {edge, element(Kind::Coil, 10, "d", {9})}), (Names{"a", "d"}));
  Element block = element(Kind::Block, 9, "", {2});
  block.type = "TON";
  block.instance = "t";
  block.outputs.emplace_back().name = "Q";
  EXPECT_EQ(derived({{Kind::Contact, "a"}}, {block, element(Kind::Coil, 10, "d", {9})}), Names{"a"});
}

}  // namespace
}  // namespace indurop::plc
