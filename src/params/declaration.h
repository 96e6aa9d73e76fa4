// Each model says once what it is and which parameters it takes. Checking, "did you mean" messages, `etendue describe`
// and the format manuals are all generated from these declarations.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "params/diagnostics.h"
#include "params/param.h"

namespace etd {

enum class Family : uint8_t {
  kShape,
  kMaterial,
  kTexture,
  kLight,
  kAreaLight,
  kCamera,
  kFilter,
  kFilm,
  kSampler,
  kIntegrator
};
std::string_view family_name(Family family);  // "shape", "material", "area light", ...

// What a parameter accepts. A kFloatTexture takes a float or the name of a float texture; a kSpectrum takes rgb,
// blackbody, spectrum or one float for all wavelengths; a kSpectrumTexture takes those or the name of a spectrum
// texture; a kImageTexture takes the name of a file or that of a spectrum texture.
enum class ParamType : uint8_t {
  kBool,
  kInteger,
  kFloat,
  kString,
  kPoint2,
  kVector2,
  kPoint3,
  kVector3,
  kNormal,
  kSpectrum,
  kFloatTexture,
  kSpectrumTexture,
  kImageTexture
};
std::string_view type_name(ParamType type);

using ParamDefault = std::variant<std::monostate, bool, int, double, std::string, std::vector<double>>;

struct ParamDecl {
  std::string name;
  ParamType type = ParamType::kFloat;
  // monostate: no default (the model treats the absence itself, or the parameter is required). A string for a spectrum
  // is the name of a named spectrum.
  ParamDefault default_value = {};
  bool required = false;
  bool array = false;  // any number of values, otherwise exactly one
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;                 // the minimum itself is not allowed
  bool clamp = false;                     // out of range is a warning and clamped, not an error
  std::vector<std::string> choices = {};  // of a string
  std::string unit = {};                  // "m", "degrees", "W/(m^2 sr)"; empty: a number
  std::string doc = {};                   // one sentence
};

struct ModelDecl {
  Family family;
  std::string name;
  std::string doc;  // one sentence
  std::vector<ParamDecl> params;

  const ParamDecl* find(std::string_view name) const;
};

// The declaration with the parameters of several parts that models share behind its own.
ModelDecl with_params(ModelDecl decl, const std::vector<std::vector<ParamDecl>>& parts);

// Reports every parameter of `use` that is unknown (with the nearest name), given twice, of the wrong type or count,
// out of range or not among the choices, and every required one that is missing.
void check_params(const ModelDecl& decl, const ModelUse& use, Diagnostics& diagnostics);

// Reads the values of one checked use by their declared names; what is absent or was reported as wrong reads as the
// default. Asking for a name or type that is not declared is a programming error and aborts.
class ParamReader {
 public:
  ParamReader(const ModelDecl& decl, const ModelUse& use, Diagnostics& diagnostics)
      : decl_(decl), use_(use), diagnostics_(diagnostics) {}

  bool boolean(std::string_view name) const;
  int integer(std::string_view name) const;
  double number(std::string_view name) const;  // of a float texture: when a number was given, otherwise the default
  std::string string(std::string_view name) const;
  std::vector<double> numbers(std::string_view name) const;  // points, vectors, floats: components in a row
  std::vector<int32_t> integers(std::string_view name) const;
  // The parameter as written when it was given and is well-formed, otherwise null. For spectra and textures, whose
  // meaning belongs to higher floors.
  const Param* given(std::string_view name) const;
  // The declaration itself, for its default and range where given() leaves the meaning to the caller.
  const ParamDecl& declaration(std::string_view name) const;

  const ModelDecl& decl() const { return decl_; }
  const ModelUse& use() const { return use_; }
  Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  const ModelDecl& decl_;
  const ModelUse& use_;
  Diagnostics& diagnostics_;
};

// "etendue describe": the declaration as text for a terminal.
std::string describe(const ModelDecl& decl);

}  // namespace etd
