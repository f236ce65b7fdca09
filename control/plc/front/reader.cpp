// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "control/plc/front/actions.h"
#include "control/plc/front/builtin.h"
#include "control/plc/front/encoding.h"
#include "control/plc/front/library_file.h"
#include "control/plc/library/standard.h"
#include "control/plc/lower/bodies.h"
#include "control/plc/openplc/read_files.h"
#include "control/plc/plcopen/read_project.h"
#include "control/plc/st/parser.h"
#include "control/plc/twincat/read_object.h"

namespace indurop::plc {
namespace {

Project read_st(std::string_view text, const Place& at, const ReadOptions& options,
                std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics) {
  return st::parse_project({text, at, options.in_editor}, bodies, diagnostics);
}

Project read_twincat(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                     std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics) {
  return twincat::read_object(text, at, bodies, diagnostics);
}

Project read_xml(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                 std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics) {
  return plcopen::read_project(text, at.file == nullptr ? std::string() : *at.file, bodies, diagnostics);
}

Project read_openplc(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                     std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics) {
  return openplc::read_project(text, at, &st::parse_project, bodies, diagnostics);
}

template <network::Body::Language Language>
Project read_drawn(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                   std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics) {
  return openplc::read_drawn(text, at, Language, bodies, diagnostics);
}

plcopen::Document document_of(Project project, std::vector<st::WrittenBody> bodies) {
  plcopen::Document out;
  out.project = std::move(project);
  for (ast::Pou& pou : out.project.pous) {
    out.pous.push_back({std::move(pou), {}, {}});
  }
  out.project.pous.clear();
  for (st::WrittenBody& body : bodies) {
    out.pous[body.pou].code = std::move(body.code);
  }
  return out;
}

plcopen::Document st_document(std::string_view text, const Place& at, const ReadOptions& options,
                              Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  Project project = st::parse_declarations({text, at, options.in_editor}, bodies, diagnostics);
  return document_of(std::move(project), std::move(bodies));
}

plcopen::Document twincat_document(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                                   Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  Project project = twincat::read_declarations(text, at, bodies, diagnostics);
  return document_of(std::move(project), std::move(bodies));
}

plcopen::Document openplc_document(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                                   Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  Project project = openplc::read_project(text, at, &st::parse_declarations, bodies, diagnostics);
  return document_of(std::move(project), std::move(bodies));
}

template <network::Body::Language Language>
plcopen::Document drawn_document(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                                 Diagnostics& diagnostics) {
  std::vector<st::WrittenBody> bodies;
  Project project = openplc::read_drawn(text, at, Language, bodies, diagnostics);
  return document_of(std::move(project), std::move(bodies));
}

plcopen::Document xml_document(std::string_view text, const Place& at, const ReadOptions& /*options*/,
                               Diagnostics& diagnostics) {
  return plcopen::read_document(text, at.file == nullptr ? std::string() : *at.file, diagnostics);
}

}  // namespace

std::span<const FileType> file_types() {
  using network::Body;
  static constexpr std::array kTypes{
      FileType{".st", &read_st, &st_document},
      FileType{".xml", &read_xml, &xml_document},
      FileType{".TcPOU", &read_twincat, &twincat_document},
      FileType{".TcDUT", &read_twincat, &twincat_document},
      FileType{".TcGVL", &read_twincat, &twincat_document},
      FileType{".TcIO", &read_twincat, &twincat_document},
      FileType{".TcTTO", &read_twincat, &twincat_document},
      FileType{".exp", &read_st, &st_document},
      FileType{".il", &read_st, &st_document},
      FileType{".dt", &read_st, &st_document},
      FileType{".ld", &read_drawn<Body::Language::Ld>, &drawn_document<Body::Language::Ld>},
      FileType{".fbd", &read_drawn<Body::Language::Fbd>, &drawn_document<Body::Language::Fbd>},
      FileType{"project.json", &read_openplc, &openplc_document}};
  return kTypes;
}

namespace {

constexpr std::string_view kProject = ".plcproj";  // of TwinCAT: names its files

bool ends_with(const std::string& file, std::string_view ending) {
  return upper(file).ends_with(upper(ending));
}

// Leaves out blocks that Beremiz writes into every program and that this program does not use.
void leave_out(Project& project, Diagnostics& diagnostics) {
  for (const ast::Pou& pou : project.pous) {
    if (!pou.c_code) {
      continue;
    }
    if (pou.kind == ast::Pou::Kind::Program) {
      diagnostics.error(*pou.c_code, "C code in { } is not supported, write it in ST, or as a module of its own");
      continue;
    }
    const bool known = !find_functions(pou.name).empty();
    diagnostics.warning(*pou.c_code, fmt::format("{} is left out, because C code in {{ }} is not supported{}", pou.name,
                                                 known ? "; the function of the library takes its place" : ""));
    project.left_out.push_back({*pou.c_code, pou.name});
  }
  std::erase_if(project.pous, [](const ast::Pou& pou) { return pou.c_code.has_value(); });
}

// Leaves out function blocks with instances of those that were left out, such as python_gear of Beremiz.
void leave_out_users(Project& project, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<std::pair<const ast::Pou*, const ast::Variable*>>> users;
  std::vector<std::string> open;
  for (const ast::NameAt& one : project.left_out) {
    open.push_back(upper(one.name));
  }
  if (open.empty()) {
    return;
  }
  for (const ast::Pou& pou : project.pous) {
    for (const ast::Variable& one : pou.variables) {
      const ast::TypeSpec* type = &one.type;
      while (type->element != nullptr) {
        type = type->element.get();
      }
      if (pou.kind == ast::Pou::Kind::FunctionBlock && type->kind == ast::TypeSpec::Kind::Named) {
        users[upper(type->name)].emplace_back(&pou, &one);
      }
    }
  }
  std::set<std::string> gone;
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    for (const auto& [pou, variable] : users[name]) {
      if (gone.insert(upper(pou->name)).second) {
        diagnostics.warning(variable->at, fmt::format("{} is left out too, because of this variable", pou->name));
        project.left_out.push_back({variable->at, pou->name});
        open.push_back(upper(pou->name));
      }
    }
  }
  std::erase_if(project.pous, [&](const ast::Pou& pou) {
    return pou.kind == ast::Pou::Kind::FunctionBlock && gone.contains(upper(pou.name));
  });
}

class FileReader {
 public:
  FileReader(const ReadOptions& options, const glb2idl::FileReader& read, Diagnostics& diagnostics)
      : options_(options), read_(read), diagnostics_(diagnostics) {}

  void file(const std::string& file) {
    if (const auto text = bytes_of(file)) {
      source(file, *text);
    }
  }

  // Errors in a library are reported with its name.
  void library(const LibraryChoice& choice) {
    const auto text = bytes_of(choice.file);
    if (!text) {
      return;
    }
    const auto read = read_library(*text);
    const Place at = place_of(choice.file);
    if (!read) {
      diagnostics_.error(at, read.error().text);
      return;
    }
    if (!choice.version.empty() && !does_for(read->version, choice.version)) {
      diagnostics_.error(at, fmt::format("this is {} {}, and {} is wanted", read->name, read->version, choice.version));
    }
    for (const auto& [name, version] : libraries_) {
      if (same_name(name, read->name)) {
        diagnostics_.error(at, fmt::format("the library {} is given twice, as {} and {}; remove one of them", name,
                                           version, read->version));
        return;
      }
    }
    libraries_.emplace_back(read->name, read->version);
    for (const LibrarySource& one : read->sources) {
      source(fmt::format("{}-{}/{}", read->name, read->version, one.name), one.text);
    }
    out_.dialect = read->dialect == Dialect::Iec ? out_.dialect : read->dialect;
  }

  // Reads a file with its code as written or drawn.
  void document(const std::string& file, plcopen::Document& to) {
    Place at = place_of(file);
    const FileType* type = type_of(file);
    const auto text = bytes_of(file);
    if (!text) {
      return;
    }
    at.line = 1;
    at.column = 1;
    if (type == nullptr) {  // a project of TwinCAT
      for (const std::string& one : twincat::files_of_project(*text, at, diagnostics_)) {
        document(one, to);
      }
      return;
    }
    if (type->read != &read_xml) {
      diagnostics_.show_lines_of(file, *text);
    }
    plcopen::Document made = type->read_document(*text, at, options_, diagnostics_);
    append(to.project, std::move(made.project));
    std::move(made.pous.begin(), made.pous.end(), std::back_inserter(to.pous));
  }

  Project take() {
    lower::lower_bodies(bodies_, out_, options_, diagnostics_);
    leave_out(out_, diagnostics_);
    leave_out_users(out_, diagnostics_);
    make_methods_of_actions(out_);
    add_builtin(out_);
    return std::move(out_);
  }

 private:
  // Returns null if the file is not a program.
  static const FileType* type_of(const std::string& file) {
    const auto types = file_types();
    const auto type =
        std::find_if(types.begin(), types.end(), [&](const FileType& one) { return ends_with(file, one.ending); });
    return type != types.end() ? &*type : nullptr;
  }

  static std::string ending_of(const std::string& file) { return std::filesystem::path(file).extension().string(); }

  static Place place_of(const std::string& file) {
    Place at;
    at.file = std::make_shared<const std::string>(file);
    return at;
  }

  std::optional<std::string> bytes_of(const std::string& file) {
    auto got = read_(file);
    if (!got.text) {
      diagnostics_.error(place_of(file), fmt::format("cannot read the file: {}", got.why));
      out_.incomplete = true;
      return std::nullopt;
    }
    if (!got.identity.empty() && !same_name(ending_of(got.identity), ending_of(file))) {
      diagnostics_.error(place_of(file), "this is a link to a file of another kind, which is not read; name that file");
      out_.incomplete = true;
      return std::nullopt;
    }
    return as_utf8(std::move(*got.text));
  }

  void source(const std::string& file, const std::string& text) {
    Place at = place_of(file);
    const FileType* type = type_of(file);
    at.line = 1;
    at.column = 1;
    if (type == nullptr) {  // a project of TwinCAT
      for (const std::string& one : twincat::files_of_project(text, at, diagnostics_)) {
        this->file(one);
      }
      return;
    }
    if (type->read != &read_xml) {
      diagnostics_.show_lines_of(file, text);
    }
    std::vector<st::WrittenBody> bodies;
    Project made = type->read(text, at, options_, bodies, diagnostics_);
    for (st::WrittenBody& body : bodies) {
      body.pou += out_.pous.size();
      bodies_.push_back(std::move(body));
    }
    append(out_, std::move(made));
  }

  const ReadOptions& options_;
  const glb2idl::FileReader& read_;
  Diagnostics& diagnostics_;
  Project out_;
  std::vector<st::WrittenBody> bodies_;                         // of its POUs, not yet translated
  std::vector<std::pair<std::string, std::string>> libraries_;  // names and versions
};

// Returns whether the ending is that of a program; else reports an error.
bool is_program(const std::string& file, Diagnostics& diagnostics) {
  const auto types = file_types();
  std::string known;
  for (const FileType& one : types) {
    if (ends_with(file, one.ending)) {
      return true;
    }
    known += std::string(one.ending) + " ";
  }
  if (ends_with(file, kProject)) {
    return true;
  }
  Place at;
  at.file = std::make_shared<const std::string>(file);
  diagnostics.error(
      at, fmt::format("the ending of the name is not one of a PLC program, use one of {}{}", known, kProject));
  return false;
}

}  // namespace

Project read_project(const std::vector<std::string>& files, const std::vector<std::string>& libraries,
                     const ReadOptions& options, const glb2idl::FileReader& read, Diagnostics& diagnostics) {
  FileReader reader(options, read, diagnostics);
  for (const std::string& one : libraries) {
    reader.library(library_choice(one));
  }
  for (const std::string& one : files) {
    if (is_program(one, diagnostics)) {
      reader.file(one);
    }
  }
  return reader.take();
}

plcopen::Document read_document(const std::vector<std::string>& files, const ReadOptions& options,
                                const glb2idl::FileReader& read, Diagnostics& diagnostics) {
  FileReader reader(options, read, diagnostics);
  plcopen::Document out;
  for (const std::string& one : files) {
    if (is_program(one, diagnostics)) {
      reader.document(one, out);
    }
  }
  return out;
}

}  // namespace indurop::plc
