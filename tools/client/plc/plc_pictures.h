// SPDX-License-Identifier: Apache-2.0
// Drawings of PLC programs with the values of running ones, as data for programs that draw themselves. Used by one
// thread.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "tools/client/failure.h"

namespace indurop::tools {

class PlcView;

// The files of one program, as for `indurop plc watch`.
struct PlcFiles {
  std::vector<std::string> files;
  std::vector<std::string> glb_files;
  std::string name;
  std::string space;
};

// Parses words "[NAME[:NAMESPACE]=]FILE[,FILE]...", one for each program; files that end in .glb are not compiled but
// used. Each program has the name of its module. Errors: a program without a file, two of the same name.
Result<std::vector<PlcFiles>, Failure> plc_programs(const std::vector<std::string>& words);

class PlcPictures {
 public:
  // The names of the programs must differ.
  explicit PlcPictures(const std::vector<PlcFiles>& programs);
  PlcPictures(const PlcPictures&) = delete;
  PlcPictures& operator=(const PlcPictures&) = delete;
  ~PlcPictures();

  // Returns the drawings of `program`, or, if it is empty, of the first one that the node runs. Errors: there is none
  // of that name; its files have errors; the node does not run it, or it was built without --watch.
  Result<base::Json, Failure> pictures(const std::string& node, const std::string& program);
  // Returns its tasks, programs and types, and where the values of its variables are. The same errors.
  Result<base::Json, Failure> model(const std::string& node, const std::string& program);
  // Returns the values that change in the drawings. The same errors.
  Result<base::Json, Failure> live(const std::string& node, const std::string& program);

 private:
  using Answer = base::Json (PlcView::*)() const;
  struct Program;
  Result<base::Json, Failure> answer(const std::string& node, const std::string& program, bool check_node, Answer what);

  std::vector<std::unique_ptr<Program>> programs_;
};

}  // namespace indurop::tools
