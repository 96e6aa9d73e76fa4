// Typed parameter lists: "float radius" [ 2 ] "string filename" "a.ply" ...
#pragma once

#include <functional>
#include <vector>

#include "formats/pbrt/token_stream.h"
#include "params/param.h"

namespace etd::pbrt {

// Reads parameters until a token that begins none. What is wrong is reported; a parameter with wrong values is marked
// as malformed, and one without a known type is left out. `is_directive` tells where a list that is not closed must
// end.
std::vector<Param> read_parameters(TokenStream& tokens, const std::function<bool(std::string_view)>& is_directive,
                                   Diagnostics& diagnostics);

}  // namespace etd::pbrt
