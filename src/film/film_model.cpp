#include "film/film_model.h"

#include "film/film_list.h"
#include "params/model_list.h"

namespace etd {

std::span<const ModelDecl* const> film_models() {
  static const std::vector<const ModelDecl*> all = declarations(Films{});
  return all;
}

FilmModel make_film_model(const ModelUse& use, const FilmContext& context, Diagnostics& diagnostics) {
  FilmModel film;
  const auto make = [&]<class T>(std::type_identity<T>, const ParamReader& p) { film = T::create(p, context); };
  if (!with_model(Films{}, use, diagnostics, make))
    make(std::type_identity<RgbFilm>(), {RgbFilm::decl(), use, diagnostics});
  return film;
}

}  // namespace etd
