// SPDX-License-Identifier: Apache-2.0
// Parses bytes into elements with places, independent of the meaning of the elements.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// The expected kind of file, for diagnostics.
struct DocumentKind {
  const char* name;  // "module.xml"
  const char* form;  // "<root> with one <module> per program"
};
inline constexpr DocumentKind kModuleXml{"module.xml", "<root> with one <module> per program"};
inline constexpr DocumentKind kPlantXml{"plant.xml", "<plant name=\"cell\"> with one <board> per board"};

// Reads the bytes of a regular file, at most slightly more than a document may have. Error: a diagnostic without a
// line.
Result<std::string, base::Diagnostic> read_bytes(const std::filesystem::path& file, const DocumentKind& kind);
// Returns the root element, or nothing after errors about `file`: larger than 4 MB, nested deeper than 32, not
// well-formed.
std::optional<base::Element> read_document(std::string_view xml, const std::filesystem::path& file,
                                           const DocumentKind& kind, std::vector<base::Diagnostic>& diagnostics);
// Returns the name of the root element even if the rest of the document is damaged; empty if there is none.
std::string root_name(std::string_view xml);

}  // namespace indurop::config
