// The difference of two pictures as a page to look at: it needs no other file, so it can be sent around.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/file.h"
#include "spectrum/srgb.h"
#include "verify/difference/difference.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

constexpr const char* kChannels[] = {"R", "G", "B"};

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>etendue diff</title>
<style>
body { font: 15px sans-serif; margin: 2em auto; max-width: 72em; padding: 0 1em; color: #222; }
h1 { font-size: 1.3em; } h2 { font-size: 1.1em; margin-top: 2em; }
pre { background: #f4f4f4; padding: 1em; overflow-x: auto; font-size: 13px; }
img { image-rendering: pixelated; width: 100%; min-width: 16em; background: #000; display: block; }
figure { display: inline-block; width: 48%; margin: 0 1% 1em 0; vertical-align: top; } figcaption { margin-top: .3em; }
table { border-collapse: collapse; font-size: 13px; } td, th { padding: .2em .8em; text-align: right; border-bottom: 1px solid #ddd; }
.verdict { font-weight: bold; padding: .6em 1em; } .same { background: #dff0d8; } .different { background: #f6d5d2; }
.unknown { background: #eee; } #flip { position: relative; width: 100%; } #flip img + img { position: absolute; top: 0; }
</style></head><body>
)";

constexpr const char* kFlipScript = R"(<script>
const top_image = document.getElementById("over"), label = document.getElementById("which");
let timer = null;
function show(b) { top_image.style.visibility = b ? "visible" : "hidden"; label.textContent = b ? "B" : "A"; }
function flip() { show(top_image.style.visibility === "hidden"); }
function blink() { if (timer) { clearInterval(timer); timer = null; } else timer = setInterval(flip, 500); }
show(false);
</script>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

// Nine points of the colour map "magma" (Smith and van der Walt 2015, CC0), straight lines between them.
void append_magma(std::vector<float>& rgb, float value) {
  constexpr float kPoints[9][3] = {{0, 0, 4},      {28, 16, 68},   {79, 18, 123},   {129, 37, 129}, {181, 54, 122},
                                   {229, 80, 100}, {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};
  const float x = std::clamp(value, 0.0f, 1.0f) * 8;
  const int i = std::min(static_cast<int>(x), 7);
  for (int c = 0; c < 3; ++c) {
    const float encoded = kPoints[i][c] + (x - static_cast<float>(i)) * (kPoints[i + 1][c] - kPoints[i][c]);
    rgb.push_back(srgb_to_linear(encoded / 255));
  }
}

Picture magma(const Plane& plane) {
  Picture picture{plane.width, plane.height, {}};
  for (const float v : plane.values) append_magma(picture.rgb, v);
  return picture;
}

// Red where a is brighter than b, blue where it is darker, full at the scale, which is the 99th percentile.
struct SignedError {
  Picture picture;
  double scale = 0;
};
SignedError signed_error(const Picture& a, const Picture& b) {
  const Plane ya = luminance_plane(a), yb = luminance_plane(b);
  std::vector<float> difference, sizes;
  for (size_t i = 0; i < ya.values.size(); ++i) {
    const float d = ya.values[i] - yb.values[i];
    difference.push_back(std::isfinite(d) ? d : 0.0f);
    sizes.push_back(std::abs(difference.back()));
  }
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 99 / 100);
  std::nth_element(sizes.begin(), at, sizes.end());
  SignedError e{{a.width, a.height, {}}, *at > 0 ? *at : *std::max_element(sizes.begin(), sizes.end())};
  for (const float d : difference) {
    const float v = e.scale > 0 ? srgb_to_linear(std::min(std::abs(d) / static_cast<float>(e.scale), 1.0f)) : 0.0f;
    for (const float channel : {d > 0 ? v : 0.0f, 0.25f * v, d < 0 ? v : 0.0f}) e.picture.rgb.push_back(channel);
  }
  return e;
}

class Page {
 public:
  explicit Page(const fs::path& folder) : folder_(folder), html_(kHead) {}

  // Writes the picture as a file, and returns it as the source of an image.
  std::string image(const std::string& name, const Picture& picture, double exposure = 0) {
    const fs::path path = folder_ / name;
    if (!error_.empty()) return {};
    error_ = write_rgb(path, picture.width, picture.height, picture.rgb, static_cast<float>(exposure));
    if (!error_.empty()) return {};
    const FileBytes bytes = read_file(path);
    error_ = bytes.error;
    return "data:image/png;base64," + base64(bytes.bytes);
  }
  void figure(const std::string& source, const std::string& caption) {
    add(fmt::format("<figure><img src=\"{}\" alt=\"\"><figcaption>{}</figcaption></figure>\n", source, caption));
  }
  void add(const std::string& html) { html_ += html; }
  std::string write() {
    if (error_.empty()) error_ = write_file(folder_ / "index.html", html_ + "</body></html>\n");
    return error_;
  }

 private:
  fs::path folder_;
  std::string html_, error_;
};

std::string histogram_svg(const HistogramTest& h) {
  constexpr double kWidth = 360, kHeight = 140, kBar = kWidth / HistogramTest::kBins;
  const double expected = static_cast<double>(h.blocks) / HistogramTest::kBins;
  const double most = std::max(2 * expected, static_cast<double>(*std::max_element(h.bins.begin(), h.bins.end())));
  std::string svg = fmt::format("<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">", kWidth, kHeight);
  for (size_t i = 0; i < h.bins.size(); ++i) {
    const double height = kHeight * static_cast<double>(h.bins[i]) / most;
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>",
                       static_cast<double>(i) * kBar, kHeight - height, kBar - 1, height,
                       h.channel == 0 ? "#c44" : (h.channel == 1 ? "#4a4" : "#46c"));
  }
  const double y = kHeight * (1 - expected / most);
  return svg +
         fmt::format("<line x1=\"0\" x2=\"{0}\" y1=\"{1:.1f}\" y2=\"{1:.1f}\" stroke=\"#000\"/></svg>", kWidth, y);
}

void add_histograms(Page& page, const Verdict& v) {
  if (v.histograms.empty()) return;
  page.add(
      "<h2>p-values of the blocks</h2><p>Equal images fill all bars alike, up to the line. Bars that rise to the "
      "left are differences.</p>\n");
  for (const HistogramTest& h : v.histograms)
    page.add(
        fmt::format("<figure style=\"width:32%\">{}<figcaption>{}: {} blocks, {} below {} (corrected p = "
                    "{:.2g})</figcaption></figure>\n",
                    histogram_svg(h), kChannels[h.channel], h.blocks, h.below, h.threshold, h.corrected));
}

void add_worst(Page& page, const Difference& d) {
  page.add(
      "<h2>Worst pixels</h2>\n<table><tr><th>x, y</th><th>A: R</th><th>G</th><th>B</th><th>B: R</th><th>G</th>"
      "<th>B</th><th>share of the relMSE</th><th>sigmas</th></tr>\n");
  for (const WorstPixel& p : d.worst) {
    page.add(fmt::format("<tr><td>{}, {}</td>", p.x, p.y));
    for (const Rgb* rgb : {&p.a, &p.b})
      for (const double v : *rgb) page.add(fmt::format("<td>{:.5g}</td>", v));
    page.add(fmt::format("<td>{:.2f} %</td><td>{}</td></tr>\n", 100 * p.share,
                         p.sigma ? fmt::format("{:.1f}", *p.sigma) : std::string("-")));
  }
  page.add("</table>\n");
}

}  // namespace

std::string write_difference_page(const Difference& d, const fs::path& folder, double exposure) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return fmt::format("the folder {} cannot be made: {}", folder.string(), failed.message());
  Page page(folder);
  const std::string a = page.image("a.png", d.a, exposure), b = page.image("b.png", d.b, exposure);
  const SignedError error = signed_error(d.a, d.b);

  constexpr const char* kClasses[] = {"same", "different", "unknown"};
  constexpr const char* kSentences[] = {"No difference found", "The images differ", "No verdict"};
  const size_t kind = static_cast<size_t>(answer(d));
  page.add(fmt::format("<h1>A: {}<br>B: {}</h1>\n<p class=\"verdict {}\">{}</p>\n", escaped(d.name_a),
                       escaped(d.name_b), kClasses[kind], kSentences[kind]));
  page.add("<pre>" + escaped(difference_text(d)) + "</pre>\n");
  page.add(
      "<h2>Flip</h2>\n<p><button onclick=\"flip()\">flip</button> <button onclick=\"blink()\">blink</button> shown: "
      "<b id=\"which\">A</b> (a click on the picture flips too)</p>\n");
  page.add(
      fmt::format("<div id=\"flip\" onclick=\"flip()\"><img src=\"{}\" alt=\"A\"><img id=\"over\" src=\"{}\" "
                  "alt=\"B\"></div>\n",
                  a, b));
  page.add("<h2>Side by side</h2>\n");
  page.figure(a, "A");
  page.figure(b, "B");
  page.figure(
      page.image("error.png", error.picture),
      fmt::format("Signed error of the luminance: red where A is brighter, blue where it is darker, full at {:.3g}",
                  error.scale));
  page.figure(page.image("flip.png", magma(d.metrics.hdr_flip)),
              fmt::format("HDR-FLIP, mean {:.4f}: black is 0, white 1", mean(d.metrics.hdr_flip)));
  page.figure(page.image("ldr-flip.png", magma(d.metrics.ldr_flip)),
              fmt::format("LDR-FLIP, mean {:.4f}", mean(d.metrics.ldr_flip)));
  if (d.verdict) add_histograms(page, *d.verdict);
  add_worst(page, d);
  page.add(kFlipScript);
  return page.write();
}

}  // namespace etd
