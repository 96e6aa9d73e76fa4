// What the pbrt-v4 language has and Etendue does not have: the one table from which unsupported uses are reported,
// replaced and documented. A model or parameter that is registered is supported, whatever stands here.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "params/declaration.h"

namespace etd::pbrt {

// A model of the language without a counterpart, and what is rendered instead when the user allows it.
struct UnsupportedModel {
  Family family;
  std::string_view name;
  std::string_view stand_in;    // the model used instead; empty: the object is left out
  std::string_view substitute;  // in words
  // Parameters that go over to the stand-in, with their names there.
  std::vector<std::pair<std::string_view, std::string_view>> kept = {};
  // A number given to the stand-in when none of `kept` sets that parameter; the name may be empty.
  std::pair<std::string_view, double> fixed = {};
};

// A parameter of models that exist here, which they do not take.
struct UnsupportedParam {
  Family family;
  std::string_view model;  // empty: every model of the family
  std::string_view name;
  // The value under which it changes nothing, as written in a file; "*": it never does here, empty: it always would.
  std::string_view harmless;
  std::string_view substitute;  // in words; of a harmless one: why
};

// An option of pbrt, and what it means here.
struct OptionRule {
  enum class Effect : uint8_t { kSeed, kNoTextureFiltering, kNone, kNote, kUnsupportedIfTrue };
  std::string_view name;
  Effect effect;
  std::string_view text;  // why it has no effect, the note, or the substitute
};

std::span<const OptionRule> known_options();
std::span<const UnsupportedModel> unsupported_models();
std::span<const UnsupportedParam> unsupported_params();

// Makes `use` one that Etendue has: reports a model or parameters that it lacks and puts the substitutes in their
// place, so that what remains is for check_params. An unknown model is an error and replaced too. Empty when the object
// must be left out.
std::optional<ModelUse> make_supported(Family family, ModelUse use, Diagnostics& diagnostics);

// The parameters to which defaults of `Attribute` apply: those that the model takes here or in the language.
std::vector<std::string_view> params_of(Family family, std::string_view model);

}  // namespace etd::pbrt
