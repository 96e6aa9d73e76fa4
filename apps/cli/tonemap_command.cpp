// `etendue tonemap`: a picture of any range becomes one for the eye.
#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "commands.h"
#include "io/cut_out.h"
#include "io/picture.h"
#include "printing.h"
#include "render/tonemap.h"
#include "spectrum/color_space.h"
#include "spectrum/white_balance.h"

namespace etd::cli {
namespace {

struct Arguments {
  std::string input, output, layer, white_balance;
  double exposure = 0;
  bool alpha = false;
  std::string curve = "srgb";
};

constexpr const char* kExamples =
    "Examples:\n"
    "  etendue tonemap box.exr box.png --exposure 1.5           one and a half stops brighter\n"
    "  etendue tonemap box.exr box.jpg --operator filmic        highlights that roll off instead of clipping\n"
    "  etendue tonemap box.exr box.png --white-balance 3200     lamps of 3200 K become white\n"
    "  etendue tonemap box.exr indirect.png --layer indirect    one layer of the render\n"
    "  etendue tonemap box.exr cut.png --alpha                  nothing but what surfaces show (render --alpha)\n";

int fail(const std::string& message) {
  tell("etendue: {}\n", message);
  return kBadInput;
}

// "auto", or a temperature as in "5000" or "5000K", of this picture. Returns what is wrong, or an empty string.
std::string set_balance(const std::string& text, std::span<const float> rgb, ToneMapping& mapping) {
  if (text.empty()) return {};
  if (text == "auto") {
    mapping.balance = grey_world_balance(rgb);
    return mapping.balance ? std::string() : "--white-balance auto: the picture's mean is no colour of light";
  }
  double kelvin = 0;
  const char* end = text.data() + text.size() - (text.back() == 'K' ? 1 : 0);
  const auto [stop, error] = std::from_chars(text.data(), end, kelvin);
  if (error != std::errc() || stop != end || !(kelvin >= kCoolestWhite && kelvin <= kHottestWhite))
    return fmt::format("--white-balance: \"{}\" is neither auto nor a temperature from {} to {} kelvin", text,
                       kCoolestWhite, kHottestWhite);
  mapping.balance = adapt_rec709(white_of_temperature(kelvin));
  return {};
}

int tonemap(const Arguments& args) {
  const std::string ending = std::filesystem::path(args.output).extension().string();
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg")
    return fail(fmt::format("{}: a picture for the eye ends in .png, .jpg or .jpeg", args.output));
  if (const std::string problem = check_output_path(args.output); !problem.empty())
    return fail(fmt::format("cannot write {}: {}", args.output, problem));
  if (args.alpha) {
    if (const std::string problem = check_alpha_path(args.output); !problem.empty())
      return fail(fmt::format("cannot write {} with --alpha: {}", args.output, problem));
  }

  const LayersResult read = read_any_layers(args.input, args.layer);
  if (!read.image) return fail(fmt::format("{}: {}", args.input, read.error));
  CutOut picture;
  if (args.alpha) {
    picture = read.layer.empty() ? cut_out(*read.image) : cut_out_layer(*read.image, read.layer);
  } else {
    LayerResult layer = layer_rgb(*read.image, read.layer);
    picture.rgb = std::move(layer.rgb), picture.error = std::move(layer.error);
  }
  if (!picture.error.empty()) return fail(fmt::format("{}: {}", args.input, picture.error));
  if (!picture.note.empty()) tell("etendue: note: {}: {}\n", args.input, picture.note);
  ToneMapping mapping;
  mapping.exposure = args.exposure;
  mapping.curve = args.curve == "filmic" ? ToneOperator::kFilmic : ToneOperator::kSrgb;
  if (const std::string problem = set_balance(args.white_balance, picture.rgb, mapping); !problem.empty())
    return fail(problem);

  if (args.alpha) divide_by_alpha(picture);
  if (const size_t bad = tone_map(picture.rgb, mapping); bad > 0)
    tell("etendue: warning: {} of the pixels are not numbers; they are black\n", bad);
  if (const std::string problem =
          write_rgb(args.output, read.image->width, read.image->height, picture.rgb, 0, picture.alpha);
      !problem.empty()) {
    tell("etendue: {}\n", problem);
    return kInternalError;
  }
  report("{}\n", args.output);
  return kOk;
}

}  // namespace

void add_tonemap(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("tonemap", "Make a picture for the eye from an image of any range.");
  command->add_option("input", args->input, "an image in linear light: .exr with its layers, .hdr, .pfm and others")
      ->required()
      ->type_name("IN");
  command->add_option("output", args->output, "the picture: .png, .jpg or .jpeg")->required()->type_name("OUT");
  command->add_option("--exposure", args->exposure, "stops by which it is made brighter (0)")
      ->type_name("EV")
      ->check(CLI::Range(-100.0, 100.0));
  command
      ->add_option("--operator", args->curve,
                   "srgb: clipped at white (default); filmic: the curve of Narkowicz (2015), near that of ACES")
      ->type_name("NAME")
      ->check(CLI::IsMember({"srgb", "filmic"}));
  command
      ->add_option("--white-balance", args->white_balance,
                   "the light that becomes white: a colour temperature from 1500 to 25000 K (6504 changes nothing), or "
                   "auto: whatever makes the mean grey")
      ->type_name("K");
  command
      ->add_option(
          "--layer", args->layer,
          "the part or layer of an EXR to show: direct, indirect, emission, albedo, stderr ... instead of the picture")
      ->type_name("NAME");
  command->add_flag("--alpha", args->alpha, "write a .png of what covers each pixel, with its alpha");
  command->footer(kExamples);
  command->callback([args, &run] { run = [args] { return tonemap(*args); }; });
}

}  // namespace etd::cli
