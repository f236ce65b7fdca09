// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/fmi/fmu.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "core/base/read_file.h"
#include "core/base/xml.h"
#include "tests/support/program.h"

namespace indurop::fmi {
namespace {

namespace fs = std::filesystem;

std::string attribute_of(const base::Element& element, const std::string& name) {
  for (const base::Attribute& one : element.attributes) {
    if (one.name == name) {
      return one.value;
    }
  }
  return {};
}

}  // namespace

Fmu::Fmu(const fs::path& project, const std::string& file, int version, const std::vector<std::string>& options)
    : version_(version) {
  std::string name = (fs::temp_directory_path() / "fmu-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
  const fs::path copy = folder_ / "project";
  fs::create_directory(copy);
  for (const auto& entry : fs::directory_iterator(project)) {
    if (entry.is_regular_file()) {
      fs::copy_file(entry.path(), copy / entry.path().filename());
    }
  }
  std::vector<std::string> command{INDUROP_FMU, (copy / file).string(), "-o", (folder_ / "made.fmu").string(),
                                   "--fmi",     std::to_string(version)};
  command.insert(command.end(), options.begin(), options.end());
  test::Program program(command);
  const test::Outcome made = program.finish();
  message_ = made.out + made.err;
  fs::remove_all(copy);
  if (made.code != 0) {
    return;
  }
  test::Program unzip({"/usr/bin/env", "python3", "-m", "zipfile", "-e", (folder_ / "made.fmu").string(),
                       (folder_ / "un packed").string()});
  EXPECT_EQ(unzip.finish().code, 0);
  read_description();
}

Fmu::~Fmu() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

std::string Fmu::library() const {
  return (folder_ / "un packed" / "binaries" / (version_ == 2 ? "linux64" : "x86_64-linux") / "made.so").string();
}

void Fmu::read_description() {
  const auto text = base::read_file(description_file());
  std::vector<base::XmlMistake> mistakes;
  const auto root =
      base::read_xml(text ? *text : std::string(), {.max_bytes = std::size_t{1} << 26U, .max_depth = 20}, mistakes);
  ASSERT_TRUE(root);
  token_ = attribute_of(*root, version_ == 2 ? "guid" : "instantiationToken");
  for (const base::Element& part : root->children) {
    if (part.name == "ModelVariables") {
      for (const base::Element& variable : part.children) {
        add_variable(variable);
      }
    }
  }
}

void Fmu::add_variable(const base::Element& element) {
  Described& one = variables_.emplace_back();
  const base::Element& typed = version_ == 2 ? element.children.at(0) : element;
  one.type = typed.name;
  for (const base::Element* part : {&element, &typed}) {
    for (const base::Attribute& attribute : part->attributes) {
      one.attributes[attribute.name] = attribute.value;
    }
  }
  one.name = one.attributes["name"];
  one.causality = one.attributes["causality"];
  one.reference = static_cast<unsigned int>(std::stoul(one.attributes["valueReference"]));
}

const Described* Fmu::find(const std::string& name) const {
  for (const Described& one : variables_) {
    if (one.name == name) {
      return &one;
    }
  }
  return nullptr;
}

unsigned int Fmu::reference(const std::string& name) const {
  const Described* const one = find(name);
  EXPECT_NE(one, nullptr) << name;
  return one == nullptr ? 0 : one->reference;
}

}  // namespace indurop::fmi
