// SPDX-License-Identifier: Apache-2.0
// PLC programs' pictures with what running ones tell, for programs that draw themselves. One thread uses it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/json.h"
#include "tools/command/failure.h"

namespace indurop::tools {

class PlcView;

// Files of one program, as `indurop plc watch` takes them.
struct PlcFiles {
  std::vector<std::string> files;
  std::vector<std::string> glb_files;
  std::string name;
  std::string space;
};

// Of words "[NAME[:NAMESPACE]=]FILE[,FILE]...", one for each program; files that end in .glb are not compiled but used.
// Each program has the name of its module. Errors: one without a file, two of a name.
Result<std::vector<PlcFiles>, Failure> plc_programs(const std::vector<std::string>& words);

class PlcPictures {
 public:
  // Their names are different.
  explicit PlcPictures(const std::vector<PlcFiles>& programs);
  PlcPictures(const PlcPictures&) = delete;
  PlcPictures& operator=(const PlcPictures&) = delete;
  ~PlcPictures();

  // What is to be drawn of `program`, or, if it is empty, of the first one that the node runs. Errors: there is none of
  // that name; its files have errors; the node does not run it, or it was built without --watch.
  Result<base::Json, Failure> pictures(const std::string& node, const std::string& program);
  // What changes in them. Errors: likewise.
  Result<base::Json, Failure> live(const std::string& node, const std::string& program);

 private:
  using Tell = base::Json (PlcView::*)() const;
  struct Program;
  Result<base::Json, Failure> tell(const std::string& node, const std::string& program, bool anew, Tell what);

  std::vector<std::unique_ptr<Program>> programs_;
};

}  // namespace indurop::tools
