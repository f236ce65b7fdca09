// SPDX-License-Identifier: Apache-2.0
// From bytes to elements with places, whatever the elements mean.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/xml_element.h"

namespace indurop::config {

// What the file should have been, for diagnostics.
struct DocumentKind {
  const char* name;  // "module.xml"
  const char* form;  // "<root> with one <module> per program"
};
inline constexpr DocumentKind kModuleXml{"module.xml", "<root> with one <module> per program"};
inline constexpr DocumentKind kPlantXml{"plant.xml", "<plant name=\"cell\"> with one <board> per board"};

// The bytes of an ordinary file, at most a little more than a document may have; else what is wrong, about no line.
Result<std::string, base::Diagnostic> read_bytes(const std::filesystem::path& file, const DocumentKind& kind);
// The root element, or empty after errors about `file`: larger than 4 MB, nested deeper than 32, not well-formed.
std::optional<base::Element> read_document(std::string_view xml, const std::filesystem::path& file,
                                           const DocumentKind& kind, std::vector<base::Diagnostic>& diagnostics);
// Name of the root element, however damaged the rest of the document is; empty if there is none.
std::string root_name(std::string_view xml);

}  // namespace indurop::config
