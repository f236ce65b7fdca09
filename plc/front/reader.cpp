// SPDX-License-Identifier: Apache-2.0
#include "plc/front/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "plc/front/encoding.h"
#include "plc/lower/chart.h"
#include "plc/lower/pou.h"
#include "plc/plcopen/read_project.h"
#include "plc/st/parser.h"

namespace indurop::plc {
namespace {

bool is_step_type(const ast::TypeDeclaration& type) {
  return type.name == lower::kStepType;
}
bool has_step_type(const Project& project) {
  return std::any_of(project.types.begin(), project.types.end(), is_step_type);
}

Project read_st(std::string_view text, const Place& at, const ReadOptions& options, Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> others;
  Project project = st::parse_project({text, at}, others, diagnostics);
  for (st::WrittenBody& other : others) {
    if (other.code.body.language == network::Body::Language::Sfc && !has_step_type(project)) {
      project.types.push_back(lower::step_type());
    }
    lower::lower_pou(other.code, options, project, project.pous[other.pou], diagnostics);
  }
  return project;
}

Project read_xml(std::string_view text, const Place& at, const ReadOptions& options, Diagnostics& diagnostics) {
  return plcopen::read_project(text, at.file == nullptr ? std::string() : *at.file, options, diagnostics);
}

}  // namespace

std::span<const FileType> file_types() {
  static constexpr std::array kTypes{FileType{".st", &read_st}, FileType{".xml", &read_xml}};
  return kTypes;
}

Project read_project(const std::vector<std::string>& files, const ReadOptions& options, const glb2idl::FileReader& read,
                     Diagnostics& diagnostics) {
  Project out;
  for (const std::string& file : files) {
    Place at;
    at.file = std::make_shared<const std::string>(file);
    const auto types = file_types();
    const auto type = std::find_if(types.begin(), types.end(),
                                   [&](const FileType& one) { return upper(file).ends_with(upper(one.ending)); });
    if (type == types.end()) {
      std::string known;
      for (const FileType& one : types) {
        known += (known.empty() ? "" : " ") + std::string(one.ending);
      }
      diagnostics.error(at, fmt::format("the ending of the name is not one of a PLC program, use one of {}", known));
      continue;
    }
    auto got = read(file);
    if (!got.text) {
      diagnostics.error(at, fmt::format("cannot read the file: {}", got.why));
      continue;
    }
    got.text = as_utf8(std::move(*got.text));
    at.line = 1;
    at.column = 1;
    if (type->read == &read_st) {
      diagnostics.show_lines_of(file, *got.text);
    }
    Project read_now = type->read(*got.text, at, options, diagnostics);
    if (has_step_type(out)) {
      std::erase_if(read_now.types, is_step_type);  // each file with a chart has it
    }
    append(out, std::move(read_now));
  }
  return out;
}

}  // namespace indurop::plc
