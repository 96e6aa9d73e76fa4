// One parameter against its declaration: the single place that knows what is well-formed, for the messages and for
// reading values alike.
#pragma once

#include <optional>
#include <string>

#include "params/declaration.h"

namespace etd {

struct ParamProblem {
  SourceLoc loc;
  std::string message, hint;
};

// The first thing that is wrong with the type, the number of values or a value; none when it can be read. A value that
// will be clamped is not a problem.
std::optional<ParamProblem> find_problem(const ModelDecl& model, const ParamDecl& decl, const Param& param);

}  // namespace etd
