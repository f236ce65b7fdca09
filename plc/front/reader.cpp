// SPDX-License-Identifier: Apache-2.0
#include "plc/front/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "plc/plcopen/read_project.h"
#include "plc/st/parser.h"

namespace indurop::plc {
namespace {

Project read_st(std::string_view text, const Place& at, const ReadOptions& /*options*/, Diagnostics& diagnostics) {
  return st::parse_project({text, at}, diagnostics);
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
      diagnostics.error(at, fmt::format("the name says no known form of PLC programs, use one of {}", known));
      continue;
    }
    const auto got = read(file);
    if (!got.text) {
      diagnostics.error(at, fmt::format("cannot read the file: {}", got.why));
      continue;
    }
    at.line = 1;
    at.column = 1;
    if (type->read == &read_st) {
      diagnostics.show_lines_of(file, *got.text);
    }
    append(out, type->read(*got.text, at, options, diagnostics));
  }
  return out;
}

}  // namespace indurop::plc
