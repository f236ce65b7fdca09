// SPDX-License-Identifier: Apache-2.0
// Programs of the golden cases exported as PLCopen XML and read again: the same code, the same drawing.

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "control/plc/front/compiler.h"
#include "control/plc/front/reader.h"
#include "control/plc/plcopen/project_writer.h"
#include "tests/golden/golden.h"

namespace indurop::plc {
namespace {

namespace fs = std::filesystem;
using golden::slurp;
using network::Element;

// A file "in.st" or "in.xml" of a case; the exported one is "out.xml".
class Export : public ::testing::TestWithParam<fs::path> {
 protected:
  [[nodiscard]] fs::path folder() const { return GetParam().parent_path(); }
  [[nodiscard]] std::string input() const { return GetParam().filename().string(); }

  [[nodiscard]] glb2idl::FileReader reader() {
    return [this](const std::string& name) {
      return glb2idl::ReadResult{name == "out.xml" ? exported_ : slurp(folder() / name), name, ""};
    };
  }
  [[nodiscard]] plcopen::Document document(const std::string& file) {
    Diagnostics diagnostics;
    plcopen::Document read = read_document({file}, {}, reader(), diagnostics);
    EXPECT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
    return read;
  }
  [[nodiscard]] std::string export_of(const std::string& file, Diagnostics& diagnostics) {
    return plcopen::write_project(document(file), {"golden", "2024-01-31T12:00:00"}, diagnostics);
  }
  [[nodiscard]] Compiled compiled(const std::string& file) {
    CompileOptions options;
    options.files = {file};
    options.name = "golden";
    options.library = true;
    for (const auto& entry : fs::directory_iterator(folder())) {
      if (entry.path().extension() == ".glb" && entry.path().stem() != "expected") {
        options.glb_files = {entry.path().filename().string()};
      }
    }
    return compile(options, reader());
  }
  // Without the places of the text: they are of another file.
  [[nodiscard]] static std::string code_of(const Compiled& program) {
    std::string text = program.glb;
    for (const ModuleText& one : program.modules) {
      text += one.cpp;
    }
    text = std::regex_replace(text, std::regex(R"re("[^"\n]*\.(st|xml)[^"\n]*")re"), "place");
    text = std::regex_replace(text, std::regex("#line [^\n]*"), "#line");
    return std::regex_replace(text, std::regex("// Written by [^\n]*"), "");
  }

  std::string exported_;
};

TEST_P(Export, Read_again_it_becomes_the_same_code) {
  const Compiled before = compiled(input());
  ASSERT_TRUE(before.ok) << base::to_text(before.diagnostics, "");
  Diagnostics diagnostics;
  exported_ = export_of(input(), diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  const Compiled after = compiled("out.xml");
  ASSERT_TRUE(after.ok) << base::to_text(after.diagnostics, "");
  EXPECT_EQ(code_of(after), code_of(before));
  EXPECT_EQ(module_xml(after.modules), module_xml(before.modules));
}

TEST_P(Export, Exported_twice_it_is_the_same_file) {
  Diagnostics diagnostics;
  exported_ = export_of(input(), diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  EXPECT_EQ(export_of("out.xml", diagnostics), exported_);
}

void expect_same_pins(const std::vector<network::Pin>& a, const std::vector<network::Pin>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].expression, b[i].expression);
    EXPECT_EQ(std::tie(a[i].negated, a[i].edge, a[i].storage), std::tie(b[i].negated, b[i].edge, b[i].storage));
    ASSERT_EQ(a[i].connections.size(), b[i].connections.size());
    for (std::size_t k = 0; k < a[i].connections.size(); ++k) {
      const network::Connection& line = a[i].connections[k];
      const network::Connection& other = b[i].connections[k];
      EXPECT_EQ(line.from, other.from);
      EXPECT_EQ(line.pin, other.pin);
      EXPECT_TRUE(line.corners.empty() || line.corners.size() == other.corners.size());
    }
  }
}

void expect_same_drawing(const network::Body& a, const network::Body& b) {
  EXPECT_EQ(a.text, b.text);
  ASSERT_EQ(a.diagram.elements.size(), b.diagram.elements.size());
  const auto& elements = a.diagram.elements;
  const bool placed =
      std::any_of(elements.begin(), elements.end(), [](const Element& one) { return one.x != 0 || one.y != 0; });
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Element& one = elements[i];
    const Element& other = b.diagram.elements[i];
    SCOPED_TRACE(network::title_of(one));
    EXPECT_EQ(one.kind, other.kind);
    EXPECT_TRUE(one.id == other.id || one.kind == Element::Kind::Title);
    EXPECT_TRUE(!placed || std::tie(one.x, one.y) == std::tie(other.x, other.y));
    EXPECT_EQ(std::tie(one.text, one.type, one.instance), std::tie(other.text, other.type, other.instance));
    EXPECT_EQ(std::tie(one.order, one.negated, one.edge, one.storage, one.initial),
              std::tie(other.order, other.negated, other.edge, other.storage, other.initial));
    expect_same_pins(one.inputs, other.inputs);
    expect_same_pins(one.in_outs, other.in_outs);
    expect_same_pins(one.outputs, other.outputs);
    EXPECT_EQ(one.actions.size(), other.actions.size());
  }
}

TEST_P(Export, Drawings_keep_their_elements_lines_and_places) {
  if (!input().ends_with(".xml")) {
    return;  // nothing is drawn in a text
  }
  Diagnostics diagnostics;
  exported_ = export_of(input(), diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  const plcopen::Document before = document(input());
  const plcopen::Document after = document("out.xml");
  ASSERT_EQ(before.pous.size(), after.pous.size());
  for (std::size_t i = 0; i < before.pous.size(); ++i) {
    SCOPED_TRACE(before.pous[i].pou.name);
    expect_same_drawing(before.pous[i].code.body, after.pous[i].code.body);
    ASSERT_EQ(before.pous[i].code.actions.size(), after.pous[i].code.actions.size());
    for (std::size_t k = 0; k < before.pous[i].code.actions.size(); ++k) {
      expect_same_drawing(before.pous[i].code.actions[k].body, after.pous[i].code.actions[k].body);
    }
  }
}

std::vector<fs::path> files() {
  std::vector<fs::path> found{fs::path(PLC_EXAMPLES) / "conveyor.xml"};
  for (const auto& [folder, file] : {std::pair{PLC_GOLDEN, "in.st"}, std::pair{PLCOPEN_GOLDEN, "in.xml"}}) {
    for (const std::string& name : golden::cases(folder, file)) {
      if (!name.starts_with("errors_")) {
        found.push_back(fs::path(folder) / name / file);
      }
    }
  }
  return found;
}

INSTANTIATE_TEST_SUITE_P(Cases, Export, ::testing::ValuesIn(files()),
                         [](const auto& one) { return one.param.parent_path().filename().string(); });

// What the format does not have is said, with its place.
TEST(Refused, What_the_format_does_not_have_is_an_error) {
  const std::string text =
      "FUNCTION_BLOCK A\nVAR_INPUT x : BOOL R_EDGE; END_VAR\nMETHOD M : BOOL M := TRUE; END_METHOD\nEND_FUNCTION_BLOCK\n"
      "TYPE U : UNION a : INT; b : WORD; END_UNION; END_TYPE\n"
      "NAMESPACE n FUNCTION F : INT F := 1; END_FUNCTION END_NAMESPACE\n"
      "FUNCTION_BLOCK B VAR r : REF_TO INT; END_VAR VAR_STAT s : INT; END_VAR ; END_FUNCTION_BLOCK\n";
  Diagnostics diagnostics;
  const plcopen::Document document = read_document(
      {"in.st"}, {}, [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; }, diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  (void)plcopen::write_project(document, {"x", "2024-01-31T12:00:00"}, diagnostics);
  std::string all;
  for (const base::Diagnostic& one : diagnostics.list()) {
    all += one.text + "\n";
  }
  for (const char* word : {"METHOD", "UNION", "NAMESPACE", "REF_TO", "VAR_STAT"}) {
    EXPECT_NE(all.find(std::string(word) + " is not part of PLCopen XML 2.01"), std::string::npos) << all;
  }
}

// The same program, of the text and of what it is exported as: the same shared variables, and code from which the places
// are taken out.
void expect_same_export(const std::string& text) {
  std::string exported;
  const glb2idl::FileReader reader = [&](const std::string& name) {
    return glb2idl::ReadResult{name == "in.st" ? text : exported, name, ""};
  };
  Diagnostics diagnostics;
  exported = plcopen::write_project(read_document({"in.st"}, {}, reader, diagnostics), {"x", "2024-01-31T12:00:00"},
                                    diagnostics);
  ASSERT_FALSE(diagnostics.failed()) << base::to_text(diagnostics.list(), "");
  CompileOptions options;
  options.name = "x";
  options.files = {"in.st"};
  const Compiled before = compile(options, reader);
  options.files = {"out.xml"};
  const Compiled after = compile(options, reader);
  ASSERT_TRUE(before.ok && after.ok) << base::to_text(after.diagnostics, "") << exported;
  EXPECT_EQ(after.glb.substr(after.glb.find('\n')), before.glb.substr(before.glb.find('\n')));
  EXPECT_EQ(module_xml(after.modules), module_xml(before.modules));
}

TEST(Outside, What_configurations_name_is_written_as_it_is_read) {
  expect_same_export(
      "FUNCTION_BLOCK F VAR k AT %I* : INT; END_VAR VAR_OUTPUT n : INT; END_VAR n := k; END_FUNCTION_BLOCK\n"
      "PROGRAM P VAR f : F; list : ARRAY[1..3] OF INT; END_VAR f(); list[1] := f.n; END_PROGRAM\n"
      "CONFIGURATION c VAR_GLOBAL go : BOOL; END_VAR\n"
      "VAR_ACCESS a : r.p.list[2] : INT READ_WRITE; b : p.f.n : INT READ_ONLY; d : r.%QW3 : WORD READ_WRITE; END_VAR\n"
      "RESOURCE r ON pc TASK t (SINGLE := go, PRIORITY := 1); PROGRAM p WITH t : P; END_RESOURCE\n"
      "VAR_CONFIG r.p.f.k AT %IW1 : INT; r.p.list : ARRAY[1..3] OF INT := [1, 2, 3]; END_VAR END_CONFIGURATION\n");
}

// Literals keep their type, their digits and every character.
TEST(Literals, Are_written_as_they_are_read) {
  const std::string text =
      "VAR_GLOBAL a : STRING := 'it$'s <\"$$\"> $0A'; b : LREAL := 1.0E300; c : TIME := T#1h2m3s4ms5us6ns;\n"
      "d : DT := DT#2024-01-31-12:30:00.25; e : ARRAY[1..2, 0..3] OF INT := [2(1), 3, 5(INT#16#7F)]; f : LREAL := 0.1;\n"
      "g : TOD := TOD#1:2:3; h : DATE := D#2000-02-29; i : LINT := -9223372036854775808; j : WORD := 16#FFFF; END_VAR\n"
      "PROGRAM p VAR_EXTERNAL a : STRING; END_VAR a := 'x]]>y'; END_PROGRAM\n";
  expect_same_export(text);
}

}  // namespace
}  // namespace indurop::plc
