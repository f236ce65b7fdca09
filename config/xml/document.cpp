// SPDX-License-Identifier: Apache-2.0
// The only file of config/ that uses the XML library.

#include "config/xml/document.h"

#include <cerrno>

#include "core/base/read_file.h"
#include "core/base/xml.h"

namespace indurop::config {
namespace {

constexpr std::size_t kMaxSize = std::size_t{4} * 1024 * 1024;
constexpr std::size_t kMaxDepth = 32;
constexpr std::string_view kTooLarge =
    "the file is larger than 4 MB; no configuration needs that, is it the right file?";

std::string read_problem(const base::FileProblem& problem, const DocumentKind& kind) {
  switch (problem.kind) {
    case base::FileProblem::Kind::Directory:
      return std::string("this is a directory; give the path of the ") + kind.name + " in it";
    case base::FileProblem::Kind::NotRegular:
      return std::string("this is not an ordinary file; give the path of the ") + kind.name;
    case base::FileProblem::Kind::TooLarge:
      return std::string(kTooLarge);
    case base::FileProblem::Kind::System:
      break;
  }
  switch (problem.sys_errno) {
    case ENOENT:
    case ENOTDIR:
      return std::string("no such file; give the path of the ") + kind.name;
    case EACCES:
      return "not allowed to read this file; check its permissions (ls -l)";
    default:
      return "cannot be read: " + problem.text;
  }
}

base::XmlRules rules_of(const DocumentKind& kind) {
  base::XmlRules rules;
  rules.name = kind.name;
  rules.form = kind.form;
  rules.purpose = "configuration";
  rules.max_bytes = kMaxSize;
  rules.max_depth = kMaxDepth;
  return rules;
}

}  // namespace

Result<std::string, base::Diagnostic> read_bytes(const std::filesystem::path& file, const DocumentKind& kind) {
  auto bytes = base::read_file(file, kMaxSize);
  if (!bytes) {
    return base::Diagnostic{base::Diagnostic::Severity::Error, file.string(), {}, read_problem(bytes.error(), kind)};
  }
  return std::move(*bytes);
}

std::optional<base::Element> read_document(std::string_view xml, const std::filesystem::path& file,
                                           const DocumentKind& kind, std::vector<base::Diagnostic>& diagnostics) {
  std::vector<base::XmlMistake> mistakes;
  auto root = base::read_xml(xml, rules_of(kind), mistakes);
  for (base::XmlMistake& mistake : mistakes) {
    diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), mistake.place, std::move(mistake.text)});
  }
  return root;
}

std::string root_name(std::string_view xml) {
  return base::xml_root_name(xml, rules_of(kModuleXml));
}

}  // namespace indurop::config
