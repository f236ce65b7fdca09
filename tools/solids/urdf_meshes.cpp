// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/urdf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/base/text.h"
#include "core/base/xml.h"
#include "core/base/xml_text.h"

namespace indurop::solids {

namespace {

using robot::Vec3;

const base::Element* child_of(const base::Element& element, std::string_view name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [&](const base::Element& child) { return child.name == name; });
  return found == element.children.end() ? nullptr : &*found;
}

const base::Attribute* attribute_of(const base::Element* element, std::string_view name) {
  if (element == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(element->attributes.begin(), element->attributes.end(),
                                  [&](const base::Attribute& one) { return one.name == name; });
  return found == element->attributes.end() ? nullptr : &*found;
}

// Returns the byte offset of a place, whose columns count UTF-8 characters.
std::size_t offset_of(const std::string& text, const base::SourcePlace& place) {
  std::size_t at = 0;
  for (int line = 1; line < place.line; ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  const auto continues = [&] { return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
  for (int column = 1; column < place.column && at < text.size(); ++column) {
    do {
      ++at;
    } while (continues());
  }
  return at;
}

// Returns the position after the end of the <collision> that begins at `begin`; nothing if it has none. They are never
// nested.
std::optional<std::size_t> end_of_collision(const std::string& text, std::size_t begin) {
  constexpr std::string_view kEnd = "</collision";
  for (std::size_t at = text.find('<', begin); at != std::string::npos; at = text.find('<', at + 1)) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = std::min(text.find("-->", at), text.size());
    } else if (text.compare(at, kEnd.size(), kEnd) == 0) {
      const std::size_t end = text.find('>', at);
      return end == std::string::npos ? std::nullopt : std::optional(end + 1);
    }
  }
  return {};
}

class Finder {
 public:
  Finder(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  FoundMeshes find() {
    base::XmlRules rules{"URDF file", "<robot> with links", "robot"};
    rules.max_bytes = std::size_t{16} << 20U;
    rules.max_depth = 32;
    rules.tolerant = true;
    std::vector<base::XmlMistake> mistakes;
    const auto root = base::read_xml(text_, rules, mistakes);
    for (const base::XmlMistake& mistake : mistakes) {
      complain(mistake.place, mistake.text);
    }
    if (root && root->name != "robot") {
      complain(root->place, fmt::format("a URDF file is a <robot> with links, not a <{}>", root->name));
    } else if (root) {
      for (const base::Element& link : root->children) {
        if (link.name == "link") {
          read_link(link);
        }
      }
    }
    return std::move(found_);
  }

 private:
  void complain(const base::SourcePlace& place, std::string what) {
    found_.mistakes.push_back({base::Diagnostic::Severity::Error, file_, place, std::move(what)});
  }

  void read_link(const base::Element& link) {
    const base::Attribute* name = attribute_of(&link, "name");
    for (const base::Element& collision : link.children) {
      const base::Element* geometry = collision.name == "collision" ? child_of(collision, "geometry") : nullptr;
      if (const base::Element* mesh = geometry == nullptr ? nullptr : child_of(*geometry, "mesh"); mesh != nullptr) {
        read_collision(name == nullptr ? "" : name->value, collision, *mesh);
      }
    }
  }

  void read_collision(const std::string& link, const base::Element& collision, const base::Element& mesh) {
    CollisionMesh one;
    one.link = link;
    one.place = collision.place;
    one.begin = offset_of(text_, collision.place);
    const auto end = end_of_collision(text_, one.begin);
    if (text_.compare(one.begin, 10, "<collision") != 0 || !end) {
      complain(collision.place, "the end of this <collision> is not found; write it as XML says");
      return;
    }
    one.end = *end;
    const base::Attribute* file = attribute_of(&mesh, "filename");
    if (file == nullptr || base::trimmed(file->value).empty()) {
      complain(mesh.place, "<mesh> needs filename=\"...\"");
      return;
    }
    one.uri = base::trimmed(file->value);
    const base::Element* origin = child_of(collision, "origin");
    Vec3 rpy = Vec3::Zero();
    const bool fine = read_three(attribute_of(origin, "xyz"), one.origin.position) &&
                      read_three(attribute_of(origin, "rpy"), rpy) &&
                      read_three(attribute_of(&mesh, "scale"), one.scale);
    if (!fine) {
      return;
    }
    if ((one.scale.array() == 0).any()) {
      complain(mesh.place, "scale has to be another number than 0 in each direction");
      return;
    }
    one.origin.orientation = robot::from_rpy(rpy);
    found_.meshes.push_back(std::move(one));
  }

  // Leaves `to` unchanged if there is no such attribute.
  bool read_three(const base::Attribute* attribute, Vec3& to) {
    if (attribute == nullptr) {
      return true;
    }
    std::istringstream words(attribute->value);
    words.imbue(std::locale::classic());
    Vec3 read;
    std::string more;
    if (!(words >> read.x() >> read.y() >> read.z()) || words >> more || !read.allFinite()) {
      complain(attribute->value_place,
               fmt::format("{} is three numbers, not {}", attribute->name, base::in_quotes(attribute->value)));
      return false;
    }
    to = read;
    return true;
  }

  const std::string& file_;
  const std::string& text_;
  FoundMeshes found_;
};

// Returns "0.12", without trailing zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.5f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') {
    text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string three(const Vec3& values) {
  return number(values.x()) + " " + number(values.y()) + " " + number(values.z());
}

std::string element_of(const robot::Solid& solid, const std::string& indent) {
  std::string shape;
  switch (solid.kind) {
    case robot::SolidKind::Box:
      shape = fmt::format("<box size=\"{}\"/>", three(2 * solid.half));
      break;
    case robot::SolidKind::Cylinder:
      shape =
          fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", number(solid.half.x()), number(2 * solid.half.z()));
      break;
    case robot::SolidKind::Ball:
      shape = fmt::format("<sphere radius=\"{}\"/>", number(solid.half.x()));
      break;
  }
  return fmt::format(
      "<collision>\n{0}  <origin xyz=\"{1}\" rpy=\"{2}\"/>\n{0}  <geometry>{3}</geometry>\n{0}</collision>", indent,
      three(solid.place.position), three(robot::to_rpy(solid.place.orientation)), shape);
}

// Returns the blanks in front of `at`, if there is nothing else before it in the line.
std::string indent_at(const std::string& text, std::size_t at) {
  const std::size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  const std::string before = text.substr(line, at - line);
  return before.find_first_not_of(" \t") == std::string::npos ? before : "";
}

}  // namespace

FoundMeshes find_meshes(const std::string& file, const std::string& text) {
  return Finder(file, text).find();
}

std::string with_solids(const std::string& text, const std::vector<CollisionMesh>& meshes,
                        const std::vector<std::vector<robot::Solid>>& solids) {
  std::string out;
  std::size_t from = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const CollisionMesh& mesh = meshes[i];
    const std::string indent = indent_at(text, mesh.begin);
    out += text.substr(from, mesh.begin - from);
    for (std::size_t k = 0; k < solids[i].size(); ++k) {
      out += (k == 0 ? "" : "\n" + indent) + element_of(solids[i][k], indent);
    }
    from = mesh.end;
  }
  return out + text.substr(from);
}

}  // namespace indurop::solids
