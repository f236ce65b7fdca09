// SPDX-License-Identifier: Apache-2.0
// A configuration with FMUs as devices, in a folder of its own, which is also that for temporary files.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace indurop::fmi {

// lag2.fmu, lag3.fmu
std::string lag(int version);
// The element of a module.xml for types_copy.so, which has variables of all types: kinds::in, kinds::out.
std::string types_module();

class Model {
 public:
  // `devices`: the content of ioconfig.xml. `modules`: elements of module.xml after that of I/O, which is called model
  // and has `options` in its element.
  explicit Model(const std::string& devices, const std::string& modules = {}, const std::string& options = {},
                 const std::string& period = "10ms");
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model();

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "module.xml"; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // Folders of unpacked FMUs.
  [[nodiscard]] std::vector<std::filesystem::path> unpacked() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace indurop::fmi
