// The state of one reading, shared by the directives. Each directive is a function that takes its arguments from the
// tokens and changes this state or the description.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scoped_map.h"
#include "formats/mesh/obj_scene.h"
#include "formats/pbrt/color_values.h"
#include "formats/pbrt/graphics_state.h"
#include "formats/pbrt/names.h"
#include "formats/pbrt/token_stream.h"
#include "params/declaration.h"
#include "scene/description.h"

namespace etd::pbrt {

class Parser {
 public:
  Parser(SceneDescription description, TokenStream stream, Diagnostics& messages)
      : diagnostics(messages), tokens(std::move(stream)), scene(std::move(description)), spectra(scene.folder) {}

  // Reads directives until the end of the stream.
  void read_directives();
  // Goes to the next directive without a word: after an error nothing in between can be trusted.
  void resynchronise();

  // Arguments. Without what is asked for, they report it and return nothing; the directive then gives up.
  std::optional<Token> string_argument(const Token& directive, std::string_view what);
  // `count` finite numbers, in brackets or not.
  std::optional<std::vector<double>> number_arguments(const Token& directive, size_t count);
  std::vector<Param> parameters();
  // A model's name and its parameters.
  std::optional<ModelUse> model_arguments(const Token& directive, std::string_view what);
  // The same, with colours of the current ColorSpace.
  std::optional<ModelUse> model_arguments(const Token& directive, std::string_view what, ColorRole role);

  // Takes colours to be in the current ColorSpace.
  void convert_colors(std::vector<Param>& params, ColorRole role);

  // The current transform for something placed in the world; reports singular ones and returns nothing.
  std::optional<TransformPair> placement(const SourceLoc& loc, std::string_view what);
  // Adds the defaults that `Attribute` gave for this target.
  void add_defaults(AttributeTarget target, Family family, ModelUse& use);

  void open_block(Block::Kind kind, const SourceLoc& loc);
  // False, and reported, when no block of this kind is open here.
  bool close_block(Block::Kind kind, const SourceLoc& loc);
  void report_open_blocks(size_t from);
  // An imported file starts with the state of here and cannot change it.
  void begin_import();

  Diagnostics& diagnostics;
  TokenStream tokens;
  SceneDescription scene;
  SpectrumFiles spectra;
  ObjFiles obj_files;
  Names names;
  GraphicsState state;
  // These are what `Attribute` gave, by what it gave them to and by name.
  ScopedMap<std::pair<AttributeTarget, std::string>, Param> defaults;
  std::deque<Block> blocks;
  ScopedMap<std::string, TransformPair> coordinate_systems;
  int object = -1;  // being defined; index into the scene's objects
  std::optional<int32_t> seed;
  SourceLoc transform_times;  // of the directive; file -1: not given
  bool any_directive = false;
  bool ends_at_world = false;  // reading stops behind WorldBegin
  bool world_begun = false;    // WorldBegin was read
  bool world_implied = false;  // it was missing, which has been reported

 private:
  // What an Import puts back at its end.
  using Counts = std::array<size_t, 3>;
  struct Importing {
    GraphicsState state;
    size_t first_block;
    Counts open;
    size_t defaults, coordinate_systems;  // marks
  };
  void end_import();
  void close_last_block();
  void read_directive(const Token& token);

  std::vector<Importing> imports_;
  size_t first_block_ = 0;  // blocks before this one belong to the importing file
  Counts open_{};           // blocks from there on, by kind
};

struct Directive {
  // Says where the directive may stand, relative to WorldBegin.
  enum class Where : uint8_t { kAnywhere, kOptions, kWorld };
  std::string_view name;
  Where where;
  void (*read)(Parser&, const Token&);
};

std::span<const Directive> transform_directives();
std::span<const Directive> option_directives();
std::span<const Directive> world_directives();
const Directive* find_directive(std::string_view name);

}  // namespace etd::pbrt
