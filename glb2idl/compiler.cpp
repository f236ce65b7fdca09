// SPDX-License-Identifier: Apache-2.0
// Reads files with their includes, in the order of their dependencies, and checks them.

#include "glb2idl/compiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "core/base/text.h"
#include "glb2idl/checker.h"
#include "glb2idl/parser.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

constexpr std::size_t kMaxFiles = 1000;
constexpr std::size_t kMaxIncludeDepth = 50;
constexpr std::string_view kExtension = ".glb";

class Compiler {
 public:
  explicit Compiler(const FileReader& read)
      : read_(read),
        diagnostics_(sources_, out_.diagnostics),
        scope_(diagnostics_),
        context_{sources_, diagnostics_, scope_, out_.program} {}

  Compilation run(const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) {
      load(input, std::nullopt);
    }
    choose_idl_constants(context_);
    if (!diagnostics_.failed()) {
      check_schemas();
    }
    out_.ok = !diagnostics_.failed();
    if (out_.ok) {
      note_arrays_of_texts();
    }
    diagnostics_.finish();
    return std::move(out_);
  }

 private:
  // Checks the schemas against the limits of the node's reader; files beyond them must not reach the node.
  void check_schemas() {
    for (const GlbFile& unit : out_.program.units) {
      if (!schema::from_json(schema::to_json(schema_of(unit))).ok()) {
        diagnostics_.error(
            fmt::format("'{}' declares more than one module can carry, use arrays or split it", unit.path));
      }
    }
  }

  void note_arrays_of_texts() {
    const auto is_one = [](const schema::Type& type) { return type.base == schema::Base::Text && !type.dims.empty(); };
    for (const GlbFile& unit : out_.program.units) {
      std::vector<std::string> names;
      for (const Item& item : unit.items) {
        const auto* variable = std::get_if<schema::Variable>(&item);
        const auto* structure = std::get_if<Structure>(&item);
        if (variable != nullptr && is_one(variable->type)) {
          names.push_back(variable->name);
        }
        for (const schema::Field& field :
             structure != nullptr ? structure->type.fields : std::vector<schema::Field>()) {
          if (is_one(field.type)) {
            names.push_back(structure->type.name + "." + field.name);
          }
        }
      }
      if (!names.empty()) {
        out_.notes.push_back(
            {base::Diagnostic::Severity::Note,
             unit.path,
             {},
             fmt::format("fastddsgen 2.3 (Debian 12) makes programs that misread arrays of texts, with all "
                         "that follows them: {}; for Fast DDS use an array of structs with one text each",
                         base::enumerate(names))});
      }
    }
  }

  void report(std::optional<Span> from, std::string text) {
    if (from) {
      diagnostics_.error(*from, std::move(text));
    } else {
      diagnostics_.error(std::move(text));
    }
  }

  // Reads, parses and checks a file once; returns its source index. `from` is the include line, if any.
  std::optional<std::uint32_t> load(const std::string& path, std::optional<Span> from) {
    ReadResult got = read_(path);
    if (!got.text) {
      report(from, fmt::format("cannot read '{}': {}", path, got.why));
      return std::nullopt;
    }
    if (const auto known = sources_.find(got.identity)) {
      return known_file(*known, from);
    }
    if (sources_.size() >= kMaxFiles || open_.size() >= kMaxIncludeDepth) {
      report(from, fmt::format("too many files: at most {}, and {} inside each other", kMaxFiles, kMaxIncludeDepth));
      return std::nullopt;
    }
    if (got.identity != path && !got.identity.ends_with(kExtension) && path.ends_with(kExtension)) {
      report(from, fmt::format("'{}' is a link to a file that is not a .glb file, name that file", path));
      return std::nullopt;
    }
    const auto stem = stem_of(path, from);
    const std::uint32_t file = sources_.add(path, std::move(got.identity), std::move(*got.text));
    out_.files.push_back(path);
    if (!stem) {
      return std::nullopt;
    }
    open_.push_back(file);
    const ast::File parsed = parse(sources_, file, tokenize(sources_, file, diagnostics_), diagnostics_);
    GlbFile unit;
    unit.path = path;
    unit.stem = *stem;
    unit.includes = load_includes(parsed, file);
    open_.pop_back();
    out_.program.units.push_back(std::move(unit));
    units_[file] = out_.program.units.size() - 1;
    context_.file = file;
    context_.unit = out_.program.units.size() - 1;
    check_file(context_, parsed);
    return file;
  }

  std::optional<std::uint32_t> known_file(std::uint32_t known, std::optional<Span> from) {
    const auto open = std::find(open_.begin(), open_.end(), known);
    if (open != open_.end() && from) {
      std::string way;
      for (auto i = open; i != open_.end(); ++i) {
        way += sources_.file(*i).path + " -> ";
      }
      report(from, fmt::format("the file includes itself: {}{}, move what both need into a third file", way,
                               sources_.file(known).path));
      return std::nullopt;
    }
    return known;
  }

  // Returns "knuRobot" of ".../knuRobot.glb"; it names the outputs, so it must be unique and valid.
  std::optional<std::string> stem_of(const std::string& path, std::optional<Span> from) {
    const std::string name = path.substr(path.rfind('/') + 1);
    if (!name.ends_with(kExtension) || name.size() == kExtension.size()) {
      report(from, fmt::format("'{}' is not a .glb file, rename it to end with .glb", path));
      return std::nullopt;
    }
    std::string stem = name.substr(0, name.size() - kExtension.size());
    const auto harmless = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    if (!std::all_of(stem.begin(), stem.end(), harmless)) {
      report(from, fmt::format("'{}' names generated files, use only letters, digits, '_' and '-' in it", name));
      return std::nullopt;
    }
    const auto [other, is_new] = stems_.emplace(lower(stem), path);
    if (!is_new) {
      report(from, fmt::format("'{}' and '{}' would generate the same files, rename one of them", other->second, path));
      return std::nullopt;
    }
    return stem;
  }

  std::vector<std::size_t> load_includes(const ast::File& parsed, std::uint32_t file) {
    std::vector<std::size_t> units;
    for (const ast::Item& item : parsed.items) {
      const auto* include = std::get_if<ast::Include>(&item);
      if (include == nullptr) {
        continue;
      }
      const auto folder = std::filesystem::path(sources_.file(file).path).parent_path();
      const auto found = load((folder / include->path).lexically_normal().string(), include->at);
      if (!found) {
        continue;
      }
      make_visible(file, *found);
      const auto unit = units_.find(*found);
      if (unit != units_.end() && std::find(units.begin(), units.end(), unit->second) == units.end()) {
        units.push_back(unit->second);
      }
    }
    return units;
  }

  // Files visible to an included file are also visible to the including one.
  void make_visible(std::uint32_t file, std::uint32_t included) {
    auto& seen = visible_[file];
    seen.insert(included);
    seen.insert(visible_[included].begin(), visible_[included].end());
    for (const std::uint32_t one : seen) {
      scope_.make_visible(file, one);
    }
  }

  const FileReader& read_;
  Sources sources_;
  Compilation out_;
  Diagnostics diagnostics_;
  Scope scope_;
  Context context_;
  std::vector<std::uint32_t> open_;                           // files being read, outermost first
  std::map<std::uint32_t, std::size_t> units_;                // file -> unit
  std::map<std::string, std::string> stems_;                  // lower case stem -> path
  std::map<std::uint32_t, std::set<std::uint32_t>> visible_;  // file -> files visible to it
};

}  // namespace

Compilation compile(const std::vector<std::string>& inputs, const FileReader& read) {
  return Compiler(read).run(inputs);
}

}  // namespace indurop::glb2idl
