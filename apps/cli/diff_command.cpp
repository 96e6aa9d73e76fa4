// `etendue diff`: are these two estimates of one image?
#include <fmt/format.h>

#include <charconv>
#include <cstdio>

#include "arguments.h"
#include "commands.h"
#include "io/file.h"
#include "printing.h"
#include "verify/difference/difference.h"

namespace etd::cli {
namespace {

struct Arguments : DifferenceOptions {
  std::string json;  // a file, or "-"
  std::string html;
};

// A command that compares ends with one of these in place of the usual codes, as diff and cmp do.
enum DiffExit : int { kSame = 0, kDiffer = 1, kFailed = 2, kNoVerdict = 3 };

constexpr const char* kExamples =
    "Examples:\n"
    "  etendue diff a.exr b.exr                          metrics, and whether they can be estimates of one image\n"
    "  etendue diff a.exr reference.exr --html out       the same as a page with pictures, out/index.html\n"
    "  etendue diff a.exr b.exr --crop 100,200,50,80     of these pixels alone: x0 <= x < x1, y0 <= y < y1\n"
    "  etendue diff a.exr b.exr --layer direct           metrics of one layer\n"
    "  etendue diff furnace.exr --expect 0.5             against exact values\n"
    "  etendue diff a.exr b.exr --json -                 for programs, to standard output\n"
    "Exit codes: 0 no difference, 1 they differ, 2 an error, 3 no verdict because an image does not tell its error\n"
    "(a picture of one layer, .png, .hdr, .pfm; only identical ones are called equal then).";

int fail(const std::string& message) {
  tell("etendue: {}\n", message);
  return kFailed;
}

int diff(const Arguments& args) {
  if (args.b.empty() == !args.expected)
    return fail("compare with a second image, or with a value: diff A B or diff A --expect VALUE");
  const DifferenceResult result = find_difference(args);
  if (!result.difference) return fail(result.error);
  const Difference& difference = *result.difference;
  if (args.json == "-")
    answer("{}", difference_json(difference));
  else
    answer("{}", difference_text(difference));
  if (!args.json.empty() && args.json != "-")
    if (const std::string problem = write_file(args.json, difference_json(difference)); !problem.empty())
      return fail(problem);
  if (!args.html.empty()) {
    if (const std::string problem = write_difference_page(difference, args.html, args.metrics.exposure);
        !problem.empty())
      return fail(problem);
    const std::string page = (std::filesystem::path(args.html) / "index.html").string();
    args.json == "-" ? tell("{}\n", page) : answer("{}\n", page);
  }
  const Answer verdict = etd::answer(difference);
  const int code = verdict == Answer::kSame ? kSame : verdict == Answer::kDifferent ? kDiffer : kNoVerdict;
  return code_after_answers(kSame, kFailed) == kSame ? code : kFailed;
}

}  // namespace

void add_diff(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("diff", "Say how two images differ, and whether more than noise does.");
  command->add_option("a", args->a, "an image: .exr with its layers, .pfm, .hdr, .png and others")
      ->required()
      ->type_name("A");
  command->add_option("b", args->b, "the image that it is compared with, the reference of all metrics")->type_name("B");
  command
      ->add_option_function<std::vector<double>>(
          "--expect",
          [args](const std::vector<double>& v) {
            if (v.size() != 1 && v.size() != 3) throw CLI::ValidationError("--expect", "takes one value or three");
            args->expected = Rgb{v[0], v[v.size() / 2], v.back()};
          },
          "exact values of every pixel in place of B")
      ->type_name("Y|R,G,B")
      ->delimiter(',')
      ->expected(1, 3);
  add_crop_option(*command, args->crop, "compare only these pixels of the full image: x0 <= x < x1, y0 <= y < y1");
  command->add_option("--layer", args->layer, "compare this part or layer: direct, indirect, emission, albedo ...")
      ->type_name("NAME");
  command
      ->add_option("--exposure", args->metrics.exposure,
                   "stops by which PSNR, SSIM, LDR-FLIP and the page brighten (0)")
      ->type_name("EV")
      ->check(CLI::Range(-100.0, 100.0));
  command->add_option("--ppd", args->metrics.pixels_per_degree, "pixels per degree of the eye that looks for FLIP (67)")
      ->type_name("N")
      ->check(CLI::Range(1.0, 1000.0));
  command->add_option("--level", args->compare.level, "probability of calling equal images different (1e-4)")
      ->type_name("P")
      ->check(CLI::Range(1e-12, 0.5));
  command->add_option("--tolerance", args->compare.tolerance, "relative difference of means that does not count (0)")
      ->type_name("T")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--error-a", args->error_a, "a picture that is the standard error of A (A-stderr.exr if present)")
      ->type_name("FILE");
  command->add_option("--error-b", args->error_b, "the same of B")->type_name("FILE");
  command->add_option("--runs", args->runs, "independent runs behind such a picture (8)")
      ->type_name("N")
      ->check(CLI::Range(2, 1000000));
  command->add_flag("--correlated", args->correlated,
                    "pixels depend on each other, whatever the file says: their replicates are used alone");
  command->add_option("--json", args->json, "write everything as JSON; - for standard output, in place of the text")
      ->type_name("FILE");
  command->add_option("--html", args->html, "write a page with pictures, index.html, into this folder")
      ->type_name("FOLDER");
  command->footer(kExamples);
  command->callback([args, &run] {
    run = [args] {
      try {
        return diff(*args);
      } catch (const std::exception& e) {  // not main()'s exit code, which would say that the images differ
        return fail(fmt::format("internal error: {}", e.what()));
      }
    };
  });
}

}  // namespace etd::cli
