#include "materials/mix.h"

#include <fmt/format.h>

namespace etd {

const ModelDecl& MixMaterial::decl() {
  static const ModelDecl d{Family::kMaterial,
                           "mix",
                           "One of two materials, chosen at random at each path vertex: a blend of both. Bumps and "
                           "normal maps are those of the two.",
                           {{.name = "materials",
                             .type = ParamType::kString,
                             .required = true,
                             .array = true,
                             .doc = "The names of the two materials."},
                            {.name = "amount",
                             .type = ParamType::kFloatTexture,
                             .default_value = 0.5,
                             .min = 0,
                             .max = 1,
                             .doc = "Share of the second material; 0 is only the first."}}};
  return d;
}

MixMaterial MixMaterial::create(const ParamReader& p, TextureBuilder& b, const MaterialNames& names) {
  MixMaterial m;
  m.amount = b.number(p, "amount");
  const Param* given = p.given("materials");
  if (!given) return m;
  if (given->strings.size() != 2) {
    p.diagnostics().error(given->loc, fmt::format("a mix is of 2 materials, not {}", given->strings.size()));
    return m;
  }
  for (size_t i = 0; i < 2; ++i) {
    const auto it = names.find(given->strings[i]);
    if (it != names.end() && it->second) {
      m.children[i] = *it->second;
      continue;
    }
    p.diagnostics().error(
        given->value_loc,
        it == names.end() ? fmt::format("there is no material \"{}\"", given->strings[i])
                          : fmt::format("material \"{}\" is an interface, which cannot be mixed", given->strings[i]));
  }
  return m;
}

}  // namespace etd
