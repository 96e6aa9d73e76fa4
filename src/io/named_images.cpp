#include "io/named_images.h"

#include <fmt/format.h>

#include "io/layer_param.h"
#include "io/missing_file.h"

namespace etd {

namespace {

std::shared_ptr<const Image> take(ImageResult& result) {
  return result.image ? std::make_shared<const Image>(std::move(*result.image)) : nullptr;
}

}  // namespace

std::shared_ptr<const Image> read_named_image(const ParamReader& params, const Param& name, const ImageSource& source,
                                              const std::string& hint) {
  Diagnostics& diagnostics = params.diagnostics();
  const std::string& text = name.strings[0];
  std::shared_ptr<const Image> image = source.find(text);
  const bool in_memory = image != nullptr;
  ImageResult result;
  if (!in_memory) {
    result = read_finite_image(source.folder / text, {{}, layer_name(params), diagnostics.limits()});
    image = take(result);
  } else {
    if (const Param* layer = params.given("layer"))
      diagnostics.warning(layer->loc, fmt::format("\"layer\" changes nothing: image \"{}\" is in memory", text));
    if (!is_finite(*image)) {
      result = finite_image(*image);
      image = take(result);
    }
  }
  if (!image) {
    std::string why = result.needs_layer ? kLayerHint : in_memory ? "" : missing_file_hint({source.folder}, text);
    if (!why.empty() && !hint.empty()) why += "\n";
    diagnostics.error(name.value_loc, fmt::format("cannot read image \"{}\": {}", text, result.error), why + hint);
  }
  for (const std::string& note : result.notes)
    diagnostics.note(name.value_loc, fmt::format("image \"{}\": {}", text, note));
  return image;
}

}  // namespace etd
