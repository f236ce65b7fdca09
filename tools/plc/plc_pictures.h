// SPDX-License-Identifier: Apache-2.0
// A PLC program's pictures with what a running one tells, for programs that draw themselves. One thread uses it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/json.h"
#include "tools/command/failure.h"

namespace indurop::tools {

// Files of one program, as `indurop plc watch` takes them.
struct PlcFiles {
  std::vector<std::string> files;
  std::vector<std::string> glb_files;
  std::string name;
  std::string space;
};

class PlcPictures {
 public:
  explicit PlcPictures(PlcFiles files);
  PlcPictures(const PlcPictures&) = delete;
  PlcPictures& operator=(const PlcPictures&) = delete;
  ~PlcPictures();

  // What is to be drawn of the program that node runs. Errors: the files have errors; the node does not run this
  // program, or it was built without --watch.
  Result<base::Json, Failure> pictures(const std::string& node);
  // What changes in them. Errors: likewise.
  Result<base::Json, Failure> live(const std::string& node);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::tools
