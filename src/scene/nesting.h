// How deep things of a description are within each other.
#pragma once

#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// Whether objects contain objects no deeper than the limits allow: all that walks through them calls itself. Reports
// the first object that is too deep.
bool check_object_nesting(const SceneDescription& description, Diagnostics& diagnostics);

// The message about something that is nested too deep.
void report_nesting(SourceLoc loc, std::string_view what, Diagnostics& diagnostics);

}  // namespace etd
