// What pbrt-v3 and before wrote otherwise: models, parameters, directives and types that pbrt-v4 renamed or dropped,
// and what to write now. The first use of any of them in a scene also prints a line about pbrt-v4's own converter.
#pragma once

#include <string>
#include <string_view>

#include "params/declaration.h"

namespace etd::pbrt {

// Each returns a line for the user, empty for a name that pbrt-v3 did not have either.
std::string old_model_hint(Family family, const ModelUse& use, Diagnostics& diagnostics);  // and on its parameters
std::string old_directive_hint(std::string_view word, const SourceLoc& loc, Diagnostics& diagnostics);
std::string old_type_hint(std::string_view type, std::string_view name, const SourceLoc& loc, Diagnostics& diagnostics);
std::string old_texture_kind_hint(std::string_view kind, const SourceLoc& loc, Diagnostics& diagnostics);

// Reports a temperature with a factor, as pbrt-v3 writes a blackbody, and marks the parameter as malformed.
void reject_old_blackbody(Param& param, Diagnostics& diagnostics);

bool is_old_directive(std::string_view word);

// Reports the parameters of pbrt-v3 that the model does not have, and takes them out.
void drop_old_params(Family family, ModelUse& use, Diagnostics& diagnostics);

}  // namespace etd::pbrt
