// SPDX-License-Identifier: Apache-2.0
// Writes ROS 2 packages: one for each namespace, with one .msg for each struct and for each variable that is not a
// single struct. The fields have the same order and sizes as in the .idl, so both describe the same bytes.

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>
#include <set>

#include "core/schema/ros_name.h"
#include "glb2idl/emit.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using schema::Base;

struct Package {
  std::map<std::string, std::string> messages;  // name -> text
  std::map<std::string, std::string> origins;   // name -> the item it was made from
  std::set<std::string> needs;                  // other packages
};

bool is_small_word(const std::string& name) noexcept {
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z';
}

std::string_view plain_word(Base base) noexcept {
  // char is one byte of text, for which ROS has no type.
  constexpr std::array<std::string_view, 12> kWords{"bool",  "uint8",  "int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "int64", "uint64", "float32", "float64"};
  return base == Base::Enum ? "int32" : kWords[static_cast<std::size_t>(base)];
}

class RosWriter {
 public:
  explicit RosWriter(RosPackages& out) : out_(out) {}

  void add(const GlbFile& unit) {
    unit_ = &unit;
    for (const Item& item : unit.items) {
      if (const auto* structure = std::get_if<Structure>(&item)) {
        add_structure(*structure);
      } else if (const auto* variable = std::get_if<schema::Variable>(&item)) {
        add_variable(*variable);
      }
    }
  }

  void finish() {
    for (const auto& [name, package] : packages_) {
      out_.outputs.push_back({name + "/package.xml", package_xml(name, package)});
      out_.outputs.push_back({name + "/CMakeLists.txt", cmake_lists(name, package)});
      for (const auto& [message, text] : package.messages) {
        out_.outputs.push_back({fmt::format("{}/msg/{}.msg", name, message), text});
      }
    }
  }

 private:
  void add_structure(const Structure& structure) {
    std::string text;
    Package& package = packages_[schema::ros_package(scope_of(structure.type.name))];
    std::map<std::string, std::string> names;
    for (const schema::Field& field : structure.type.fields) {
      const std::string name = schema::ros_field(field.name);
      const auto [first, is_first] = names.try_emplace(name, field.name);
      if (!is_first) {
        complain(fmt::format("the fields {} and {} of {} would both be called {} in ROS 2; rename one", first->second,
                             field.name, structure.type.name, name));
      }
      if (!is_small_word(name)) {
        complain(fmt::format("the field {} of {} has no name in ROS 2; let it begin with a letter", field.name,
                             structure.type.name));
      }
      text += field_line(package, structure.type.name, field, name);
    }
    add_message(package, structure.type.name, "struct " + structure.type.name, structure.description, text);
  }

  void add_variable(const schema::Variable& variable) {
    if (!is_wrapped(variable.type)) {
      return;
    }
    Package& package = packages_[schema::ros_package(scope_of(variable.name))];
    schema::Field value;
    value.name = "value";
    value.type = variable.type;
    value.unit = variable.unit;
    value.range = variable.range;
    add_message(package, variable.name, "variable " + variable.name, variable.description,
                field_line(package, variable.name, value, "value"));
  }

  void add_message(Package& package, const std::string& full_name, const std::string& origin,
                   const std::string& description, const std::string& fields) {
    const std::string name = schema::ros_message(last_of(full_name));
    const auto [first, is_first] = package.origins.try_emplace(name, origin);
    if (!is_first) {
      complain(fmt::format("{} and {} would both be the message {} in ROS 2; rename one", first->second, origin, name));
    }
    package.messages[name] =
        fmt::format("# {} of {}.glb, written by glb2idl. Do not edit.\n{}{}", origin, unit_->stem,
                    description.empty() ? "" : fmt::format("# {}\n", comment_line(description)), fields);
  }

  std::string field_line(Package& package, const std::string& owner, const schema::Field& field,
                         const std::string& name) {
    std::string about = field.description;
    if (!field.unit.empty()) {
      about += fmt::format("{}[{}]", about.empty() ? "" : " ", field.unit);
    }
    if (field.range) {
      about += fmt::format("{}{} to {}", about.empty() ? "" : " ", field.range->min, field.range->max);
    }
    if (field.type.dims.size() > 1) {
      about += fmt::format("{}{}, row by row", about.empty() ? "" : " ", schema::display_name(field.type));
    }
    std::string text;
    for (const schema::Enumerator& one : field.type.enumerators) {
      text += fmt::format("int32 {}_{}={}\n", schema::ros_constant(name), schema::ros_constant(one.name), one.value);
    }
    return text + fmt::format("{}{} {}{}\n", type_word(package, scope_of(owner), field.type), dims(field.type), name,
                              about.empty() ? "" : "  # " + comment_line(about));
  }

  static std::string type_word(Package& package, std::string_view scope, const schema::Type& type) {
    if (type.base == Base::Text) {
      return fmt::format("string<={}", type.text_size - 1);
    }
    if (type.base != Base::Struct) {
      return std::string(plain_word(type.base));
    }
    const std::string message = schema::ros_message(last_of(type.name));
    const std::string other = schema::ros_package(scope_of(type.name));
    if (other == schema::ros_package(scope)) {
      return message;
    }
    package.needs.insert(other);
    return fmt::format("{}/{}", other, message);
  }

  // ROS has only one-dimensional arrays; the bytes are the same.
  static std::string dims(const schema::Type& type) {
    std::uint64_t elements = 1;
    for (const std::uint32_t dim : type.dims) {
      elements *= dim;
    }
    return type.dims.empty() ? std::string() : fmt::format("[{}]", elements);
  }

  static std::string package_xml(const std::string& name, const Package& package) {
    std::string needs;
    for (const std::string& other : package.needs) {
      needs += fmt::format("  <depend>{}</depend>\n", other);
    }
    return fmt::format(R"(<?xml version="1.0"?>
<package format="3">
  <name>{}</name>
  <version>0.0.0</version>
  <description>Messages of shared variables, written by glb2idl</description>
  <maintainer email="nobody@example.com">nobody</maintainer>
  <license>as the .glb files</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
{}  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
)",
                       name, needs);
  }

  static std::string cmake_lists(const std::string& name, const Package& package) {
    std::string find;
    std::string depend;
    for (const std::string& other : package.needs) {
      find += fmt::format("find_package({} REQUIRED)\n", other);
      depend += (depend.empty() ? "\n  DEPENDENCIES " : " ") + other;
    }
    std::string messages;
    for (const auto& [message, text] : package.messages) {
      messages += fmt::format("\n  msg/{}.msg", message);
    }
    return fmt::format(R"(# Written by glb2idl. Do not edit.
cmake_minimum_required(VERSION 3.8)
project({})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{}rosidl_generate_interfaces(${{PROJECT_NAME}}{}{})
ament_export_dependencies(rosidl_default_runtime)
ament_package()
)",
                       name, find, messages, depend);
  }

  void complain(std::string text) {
    out_.problems.push_back({base::Diagnostic::Severity::Error, unit_->path, {}, std::move(text)});
  }

  RosPackages& out_;
  const GlbFile* unit_ = nullptr;
  std::map<std::string, Package> packages_;
};

}  // namespace

RosPackages emit_ros2(const Program& program) {
  RosPackages out;
  RosWriter writer(out);
  for (const GlbFile& unit : program.units) {
    writer.add(unit);
  }
  if (out.problems.empty()) {
    writer.finish();
  }
  return out;
}

}  // namespace indurop::glb2idl
