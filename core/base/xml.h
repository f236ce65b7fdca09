// SPDX-License-Identifier: Apache-2.0
// Reads an XML document to elements with places. The only part of the product that knows the XML library.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/xml_element.h"
#include "core/base/xml_places.h"

namespace indurop::base {

// Returns the root element, or nothing after at least one mistake: too large, in another encoding than UTF-8, nested
// too deep, not well-formed. Accepts any bytes. Not real-time safe.
[[nodiscard]] std::optional<Element> read_xml(std::string_view bytes, const XmlRules& rules,
                                              std::vector<XmlMistake>& mistakes);

// Returns the name of the root element, even if the rest of the document is damaged; empty if there is none.
[[nodiscard]] std::string xml_root_name(std::string_view bytes, const XmlRules& rules);

}  // namespace indurop::base
