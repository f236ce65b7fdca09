// SPDX-License-Identifier: Apache-2.0
// Each folder beside this file is a case: in.xml in the manner of an editor, its networks as text and what they
// mean in Structured Text, or the errors in it. After a wanted change of the output run the test with
// INDUROP_UPDATE_GOLDEN=1 and look at the difference.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "control/plc/lower/bodies.h"
#include "control/plc/plcopen/document.h"
#include "control/plc/plcopen/read_project.h"
#include "control/plc/print/print.h"
#include "control/plc/print/st_text.h"
#include "tests/golden/golden.h"

namespace indurop::plc {
namespace {

namespace fs = std::filesystem;
using golden::expect_file;
using golden::slurp;

Project lowered(const std::string& text, const ReadOptions& options, Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  Project project = plcopen::read_project(text, "in.xml", bodies, diagnostics);
  lower::lower_bodies(bodies, project, options, diagnostics);
  return project;
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, Networks_and_their_meaning_or_errors_are_as_expected) {
  const fs::path folder = fs::path(PLCOPEN_GOLDEN) / GetParam();
  Diagnostics diagnostics;
  plcopen::Document document = plcopen::read_document(slurp(folder / "in.xml"), "in.xml", diagnostics);
  const auto bodies = printed_bodies(document, "");
  const std::string text = print_text(bodies, true, diagnostics);
  std::string statements;
  for (const ast::Pou& pou : lowered(slurp(folder / "in.xml"), {}, diagnostics).pous) {
    statements += st_text(pou) + "\n";
  }
  expect_file(folder / "expected.err", base::to_text(diagnostics.list(), "indurop plc"));
  expect_file(folder / "expected.st", diagnostics.failed() ? "" : statements);
  expect_file(folder / "expected.txt", diagnostics.failed() ? "" : text);
  const bool chart = std::any_of(bodies.begin(), bodies.end(), [](const PrintedBody& each) {
    return each.body->language == network::Body::Language::Sfc;
  });
  expect_file(folder / "expected.svg", chart && !diagnostics.failed() ? print_svg(bodies, diagnostics) : "");
}

TEST_P(Golden, A_file_cut_off_anywhere_is_an_error_and_no_crash) {
  const std::string whole = slurp(fs::path(PLCOPEN_GOLDEN) / GetParam() / "in.xml");
  constexpr std::size_t kStep = 97;
  for (std::size_t length = 0; length < whole.size() - 12; length += kStep) {
    Diagnostics diagnostics;
    plcopen::Document document = plcopen::read_document(whole.substr(0, length), "in.xml", diagnostics);
    EXPECT_TRUE(diagnostics.failed()) << length;
  }
}

// Numbers changed, pieces lost and doubled: programs no editor writes.
std::string damaged(std::string text, std::mt19937& random) {
  const auto anywhere = [&] { return random() % text.size(); };
  for (unsigned i = 0; i <= random() % 4; ++i) {
    const std::size_t digit = text.find_first_of("0123456789", anywhere());
    switch (random() % 4) {
      case 0:
        text[digit == std::string::npos ? 0 : digit] = static_cast<char>('0' + random() % 10);
        break;
      case 1:
        text.erase(anywhere(), random() % 40);
        break;
      case 2:
        text.insert(anywhere(), text.substr(anywhere(), random() % 200));
        break;
      default:
        text[anywhere()] = static_cast<char>(32 + random() % 95);
    }
  }
  return text;
}

TEST_P(Golden, A_damaged_file_is_read_to_errors_or_a_program) {
  const std::string whole = slurp(fs::path(PLCOPEN_GOLDEN) / GetParam() / "in.xml");
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same files in every run
  constexpr int kFiles = 400;
  int drawn = 0;
  for (int i = 0; i < kFiles; ++i) {
    const std::string text = damaged(whole, random);
    Diagnostics diagnostics;
    (void)lowered(text, {true}, diagnostics);
    plcopen::Document document = plcopen::read_document(text, "in.xml", diagnostics);
    const auto bodies = printed_bodies(document, "");
    const std::string printed = print_text(bodies, false, diagnostics);
    drawn += !diagnostics.failed() && !print_svg(bodies, diagnostics).empty() && !printed.empty() ? 1 : 0;
  }
  EXPECT_LT(drawn, kFiles);
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, ::testing::ValuesIn(golden::cases(PLCOPEN_GOLDEN, "in.xml")),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace indurop::plc
