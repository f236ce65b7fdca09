// SPDX-License-Identifier: Apache-2.0
#include "plc/front/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

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

plcopen::Document st_document(std::string_view text, const Place& at, Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  plcopen::Document out;
  out.project = st::parse_declarations({text, at}, bodies, diagnostics);
  for (ast::Pou& pou : out.project.pous) {
    out.pous.push_back({std::move(pou), {}});
  }
  out.project.pous.clear();
  for (st::WrittenBody& body : bodies) {
    out.pous[body.pou].code = std::move(body.code);
  }
  return out;
}

plcopen::Document xml_document(std::string_view text, const Place& at, Diagnostics& diagnostics) {
  return plcopen::read_document(text, at.file == nullptr ? std::string() : *at.file, diagnostics);
}

const FileType* type_of(const std::string& file, const Place& at, Diagnostics& diagnostics) {
  const auto types = file_types();
  const auto type = std::find_if(types.begin(), types.end(),
                                 [&](const FileType& one) { return upper(file).ends_with(upper(one.ending)); });
  if (type != types.end()) {
    return &*type;
  }
  std::string known;
  for (const FileType& one : types) {
    known += (known.empty() ? "" : " ") + std::string(one.ending);
  }
  diagnostics.error(at, fmt::format("the ending of the name is not one of a PLC program, use one of {}", known));
  return nullptr;
}

// Calls `take(type, text, place of its first character)` with each file that can be read.
template <class Take>
void each_file(const std::vector<std::string>& files, const glb2idl::FileReader& read, Diagnostics& diagnostics,
               Take take) {
  for (const std::string& file : files) {
    Place at;
    at.file = std::make_shared<const std::string>(file);
    const FileType* type = type_of(file, at, diagnostics);
    if (type == nullptr) {
      continue;
    }
    auto got = read(file);
    if (!got.text) {
      diagnostics.error(at, fmt::format("cannot read the file: {}", got.why));
      continue;
    }
    const std::string text = as_utf8(std::move(*got.text));
    at.line = 1;
    at.column = 1;
    if (type->read == &read_st) {
      diagnostics.show_lines_of(file, text);
    }
    take(*type, text, at);
  }
}

}  // namespace

std::span<const FileType> file_types() {
  static constexpr std::array kTypes{FileType{".st", &read_st, &st_document},
                                     FileType{".xml", &read_xml, &xml_document}};
  return kTypes;
}

Project read_project(const std::vector<std::string>& files, const ReadOptions& options, const glb2idl::FileReader& read,
                     Diagnostics& diagnostics) {
  Project out;
  each_file(files, read, diagnostics, [&](const FileType& type, std::string_view text, const Place& at) {
    Project read_now = type.read(text, at, options, diagnostics);
    if (has_step_type(out)) {
      std::erase_if(read_now.types, is_step_type);  // each file with a chart has it
    }
    append(out, std::move(read_now));
  });
  return out;
}

plcopen::Document read_document(const std::vector<std::string>& files, const glb2idl::FileReader& read,
                                Diagnostics& diagnostics) {
  plcopen::Document out;
  each_file(files, read, diagnostics, [&](const FileType& type, std::string_view text, const Place& at) {
    plcopen::Document read_now = type.read_document(text, at, diagnostics);
    append(out.project, std::move(read_now.project));
    std::move(read_now.pous.begin(), read_now.pous.end(), std::back_inserter(out.pous));
  });
  return out;
}

}  // namespace indurop::plc
