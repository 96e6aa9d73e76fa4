#include "other_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "params/diagnostics.h"

namespace etd::cli {
namespace {

// Names that other renderers (pbrt, Mitsuba, Blender and Cycles, Tungsten, appleseed, POV-Ray, Arnold and others) have,
// and what is written here. An option that begins with "--" is told of commands that have it alone.
struct OtherName {
  std::string_view names;  // with blanks around each
  std::string_view meant, why;
};
constexpr std::array<OtherName, 21> kOtherNames = {
    {{" outfile out outputfile output-file outputpath output-path render-output image imagefile image-file filename ",
      "--output FILE", "several of them are possible: -o a.exr -o a.png"},
     {" samples pixelsamples pixel-samples pixel_samples sample-count samples-per-pixel samplesperpixel aa as "
      "aa-samples aa_samples num-samples nsamples passes max-samples cycles-samples ",
      "--spp N", "samples for each pixel"},
     {" width height w h xresolution yresolution xres yres resolution res image-size imagesize dimensions render-size "
      "film-size ",
      "--size WIDTHxHEIGHT", "as in --size 640x360"},
     {" nthreads num-threads numthreads threadcount thread-count cores jobs j t cpus nproc workers ", "--threads N",
      ""},
     {" cropwindow crop-window cropbounds pixelbounds pixel-bounds window region render-region border bucket-region "
      "roi ",
      "--crop x0,x1,y0,y1", "in pixels: x0 <= x < x1, y0 <= y < y1"},
     {" bounces max-bounces maxbounces depth maxdepth max_depth ray-depth raydepth path-length max-path-length ",
      "--max-depth N", "scattering events of the longest path"},
     {" timeout time-limit timelimit max-time maxtime render-time budget ", "--time TIME", "as in --time 2m"},
     {" noise noise-threshold noise-level threshold target-error max-error adaptive adaptive-threshold ", "--error E",
      "stops at that relative error"},
     {" display-server display-address tev-server display ", "--tev HOST[:PORT]", ""},
     {" write-partial-images partial progressive interactive snapshot-interval ", "--preview FILE",
      "a picture that is rewritten while it renders"},
     {" gain ev brightness ", "--exposure EV", "in stops"},
     {" random-seed randomseed rng-seed rnd ", "--seed N", ""},
     {" define param parameter option override D ", "--set NAME=VALUE", "as in --set integrator.maxdepth=8"},
     {" engine technique renderer algorithm method ", "--integrator NAME",
      "the algorithm, in place of the scene's: etendue describe integrator"},
     {" gpu device cuda optix wavefront backend ", "", "rendering runs on the processor; leave it out"},
     {" scene i input file f inputfile input-file b background ", "",
      "the scene is written without an option: etendue render SCENE"},
     {" format F render-format output-format ", "", "the ending of the output says the format: -o picture.png"},
     {" upgrade toply ", "", "the program of pbrt-v4 rewrites scenes"},
     {" mse-reference-image mse-reference-out reference ref ", "", "etendue diff compares two images"},
     {" denoise denoiser ", "", "there is no denoiser yet"},
     {" verbose v log-level log-file loglevel debug debugstart quick ", "",
      "leave it out; --stats FILE keeps numbers"}}};

// Options of one word that some programs write with a plus or a single dash: +W640, -outfile.
std::string bare_name(std::string_view word) {
  const size_t begin = word.find_first_not_of("-+");
  if (begin == std::string_view::npos) return {};
  word.remove_prefix(begin);
  return std::string(word.substr(0, word.find('=')));
}

bool is_number(std::string_view word) {
  return word.size() > 1 && (std::isdigit(static_cast<unsigned char>(word[1])) || word[1] == '.');
}

bool is_ours(const CLI::App& command, const std::string& option) {
  return command.get_option_no_throw(option) != nullptr;
}

// Whether the parser reads the word as an option of ours.
bool is_known(const CLI::App& command, const std::string& word) {
  if (word.compare(0, 2, "--") == 0) return word.size() == 2 || is_ours(command, "--" + bare_name(word));
  if (word[0] == '+' || !is_ours(command, word.substr(0, 2))) return false;
  // "-outfile" is read as "-o utfile", which nobody means.
  const std::string name = bare_name(word);
  return name.size() < 3 || !std::any_of(kOtherNames.begin(), kOtherNames.end(), [&](const OtherName& o) {
           return o.names.find(" " + name + " ") != std::string_view::npos;
         });
}

const OtherName* find_other(const std::string& name) {
  const auto has = [&](std::string_view word) {
    return std::find_if(kOtherNames.begin(), kOtherNames.end(), [&](const OtherName& o) {
      return o.names.find(fmt::format(" {} ", word)) != std::string_view::npos;
    });
  };
  auto found = has(name);
  if (found == kOtherNames.end()) {
    // +W640 and the like; capitals of other programs.
    std::string lower = name.substr(0, name.find_first_of("0123456789"));
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    found = has(lower);
  }
  return found == kOtherNames.end() ? nullptr : &*found;
}

std::string nearest_option(const CLI::App& command, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::Option* o : command.get_options())
    for (const std::string& n : o->get_lnames()) names.push_back(n);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view near = nearest_name(name, views);
  return near.empty() ? std::string() : fmt::format("--{}", near);
}

// Another command that has the option.
std::string other_command(const CLI::App& command, const std::string& option) {
  const CLI::App* parent = command.get_parent();
  if (!parent) return {};
  for (const CLI::App* sibling : parent->get_subcommands(nullptr))
    if (sibling != &command && is_ours(*sibling, option)) return sibling->get_name();
  return {};
}

// "etendue verify scene".
std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent ? full_name(*parent) + " " : std::string()) + command.get_name();
}

std::string what_was_meant(const CLI::App& command, const std::string& word) {
  const std::string name = bare_name(word);
  if (is_ours(command, "--" + name)) return fmt::format("did you mean \"--{}\"?", name);
  if (const OtherName* other = find_other(name)) {
    const std::string option(other->meant.substr(0, other->meant.find(' ')));
    if (option.empty()) return std::string(other->why);
    const std::string where = is_ours(command, option) ? std::string() : other_command(command, option);
    if (is_ours(command, option) || !where.empty())
      return fmt::format("did you mean \"{}\"{}?{}{}", other->meant,
                         where.empty() ? "" : fmt::format(" of `etendue {}`", where), other->why.empty() ? "" : " ",
                         other->why);
  }
  if (const std::string where = other_command(command, "--" + name); !where.empty())
    return fmt::format("it is an option of `etendue {}`", where);
  if (const std::string near = nearest_option(command, name); !near.empty())
    return fmt::format("did you mean \"{}\"?", near);
  return {};
}

// A picture's name where only scenes stand: other renderers take it there.
std::string misplaced_output(const CLI::App& command) {
  if (!is_ours(command, "--output")) return {};
  for (const std::string& word : command.remaining())
    for (const std::string_view ending : {".exr", ".png", ".jpg", ".jpeg", ".hdr", ".pfm"})
      if (word.size() > ending.size() && word.compare(word.size() - ending.size(), ending.size(), ending) == 0)
        return fmt::format("etendue: `{0}` does not expect \"{1}\"\n  did you mean \"-o {1}\"?\n", full_name(command),
                           word);
  return {};
}

}  // namespace

std::string unknown_options(const CLI::App& command, const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    if (word == "--") break;
    if (word.size() < 2 || (word[0] != '-' && word[0] != '+') || is_number(word) || is_known(command, word)) continue;
    text += fmt::format("etendue: `{}` has no option \"{}\"\n", full_name(command), word.substr(0, word.find('=')));
    if (const std::string meant = what_was_meant(command, word); !meant.empty()) text += fmt::format("  {}\n", meant);
  }
  if (text.empty()) return misplaced_output(command);
  text += fmt::format("  `{} --help` lists them all\n", full_name(command));
  return text;
}

}  // namespace etd::cli
