// SPDX-License-Identifier: Apache-2.0
// An FMU that indurop-fmu made of a project which is deleted afterwards, unpacked by a program that keeps no modes of
// files, as those of masters do.

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/xml_element.h"

namespace indurop::fmi {

struct Described {
  std::string name;
  std::string type;  // "Real", "Float64"
  std::string causality;
  unsigned int reference = 0;
  std::map<std::string, std::string> attributes;  // of the variable and of its type
};

class Fmu {
 public:
  // Copies `project` (a folder), makes an FMU of its file, and removes the copy.
  Fmu(const std::filesystem::path& project, const std::string& file, int version,
      const std::vector<std::string>& options = {});
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;
  ~Fmu();

  [[nodiscard]] const std::string& message() const { return message_; }  // what indurop-fmu printed
  [[nodiscard]] std::filesystem::path archive() const { return folder_ / "made.fmu"; }
  [[nodiscard]] std::string library() const;
  [[nodiscard]] std::string uri() const { return "file://" + resources(); }
  [[nodiscard]] std::string resources() const { return (folder_ / "un packed" / "resources").string(); }
  [[nodiscard]] std::filesystem::path description_file() const {
    return folder_ / "un packed" / "modelDescription.xml";
  }
  [[nodiscard]] const std::string& token() const { return token_; }
  [[nodiscard]] const std::vector<Described>& variables() const { return variables_; }
  [[nodiscard]] unsigned int reference(const std::string& name) const;
  [[nodiscard]] const Described* find(const std::string& name) const;

 private:
  void read_description();
  void add_variable(const base::Element& element);

  std::filesystem::path folder_;
  int version_;
  std::string message_;
  std::string token_;
  std::vector<Described> variables_;
};

}  // namespace indurop::fmi
