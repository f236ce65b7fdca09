// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/fmi/model.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <fstream>

namespace indurop::fmi {

namespace fs = std::filesystem;

std::string lag(int version) {
  return fmt::format("{}/lag{}.fmu", LAG, version);
}

std::string types_module() {
  return fmt::format(R"(<module><filename>{}/types_copy.so</filename><moduletype>thread</moduletype>
    <operationtype>periodic</operationtype><period>10ms</period><priority>2</priority></module>)",
                     TYPES);
}

Model::Model(const std::string& devices, const std::string& modules, const std::string& options,
             const std::string& period) {
  ::unsetenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): no other thread
  std::string name = (fs::temp_directory_path() / "model-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
  fs::create_directory(folder_ / "tmp");
  ::setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);  // NOLINT(concurrency-mt-unsafe): no other thread
  std::ofstream(folder_ / "ioconfig.xml") << "<ioconfig>\n" << devices << "\n</ioconfig>\n";
  std::ofstream(folder_ / "module.xml") << fmt::format(R"(<root>
  <module>
    <filename>{}</filename>
    <name>model</name>
    <moduletype>thread</moduletype>
    <operationtype>periodic</operationtype>
    <period>{}</period>
    <priority>1</priority>
    <property><value name="config">ioconfig.xml</value></property>
    {}
  </module>
  {}
</root>
)",
                                                       IO_MODULE, period, options, modules);
}

Model::~Model() {
  ::unsetenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): no other thread
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::vector<fs::path> Model::unpacked() const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder_ / "tmp")) {
    if (entry.path().filename().string().starts_with("indurop-fmu-")) {
      found.push_back(entry.path());
    }
  }
  return found;
}

}  // namespace indurop::fmi
