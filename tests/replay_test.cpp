// A replayed sample is the sample of the image, bit for bit, and what it tells adds up to it.
#include "render/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/flush_to_zero.h"
#include "film/invalid_samples.h"
#include "formats/pbrt/reader.h"
#include "io/image_write.h"
#include "render/overrides.h"
#include "render/provenance.h"
#include "render_helper.h"
#include "same_bits.h"
#include "scene/info.h"
#include "temp_folder.h"

namespace etd {
namespace {

struct Prepared {
  Diagnostics diagnostics;
  std::optional<PreparedRender> render;

  Prepared(const SceneDescription& description, const RenderOverrides& overrides) {
    render = prepare_render(description, overrides, diagnostics);
    EXPECT_TRUE(render) << diagnostics.format_all();
  }
  Prepared(const std::string& file, const RenderOverrides& overrides) {
    render = prepare_render(read_pbrt(source_path(file), diagnostics), overrides, diagnostics);
    EXPECT_TRUE(render) << diagnostics.format_all();
  }
  ReplayedScene scene() const {
    return {*render->compiled.scene, render->compiled.info->names, diagnostics.sources(), render->settings.film.sensor};
  }
  PathRecord replay(const SampleId& id) const {
    PathRecord path;
    EXPECT_TRUE(render->integrator->replay(id, path));
    return path;
  }
  FinishedRender run() {
    RenderObserver nobody;
    return run_render(*render, nobody);
  }
};

// What the recorded contributions add up to, in their order.
PixelSample sum_of_contributions(const PathRecord& path) {
  const FlushToZero as_in_a_render;
  PixelSample sum;
  const auto add = [&sum](int depth, const std::optional<Spectrum>& c) {
    if (c) (depth == 0 ? sum.emission : depth == 1 ? sum.direct : sum.indirect) += *c;
  };
  for (const PathVertex& v : path.vertices) {
    for (const EmissionRecord& e : v.emission) add(v.depth, e.contribution);
    if (v.light) add(v.depth + 1, v.light->contribution);
  }
  return sum;
}

void expect_same_light(const PixelSample& a, const PixelSample& b, const std::string& where) {
  for (int i = 0; i < Spectrum::kActive; ++i) {
    EXPECT_EQ(float_bits(a.emission[i]), float_bits(b.emission[i])) << where;
    EXPECT_EQ(float_bits(a.direct[i]), float_bits(b.direct[i])) << where;
    EXPECT_EQ(float_bits(a.indirect[i]), float_bits(b.indirect[i])) << where;
  }
}

// Expects of every sample of a small image that its replay is the same.
void expect_replays(const std::string& file, const RenderOverrides& overrides) {
  Prepared prepared(file, overrides);
  const FinishedRender finished = prepared.run();
  const RenderSettings& s = prepared.render->settings;
  size_t lit = 0;
  Film again(finished.film.settings());
  for (int y = s.film.crop.y0; y < s.film.crop.y1; ++y)
    for (int x = s.film.crop.x0; x < s.film.crop.x1; ++x) {
      const std::string where = fmt::format("{} pixel {},{}", file, x, y);
      for (uint32_t replicate = 0; replicate < s.film.replicates; ++replicate) {
        for (Pass pass = first_pass(s.spp / s.film.replicates); pass.begin < s.spp / s.film.replicates;
             pass = next_pass(pass, s.spp / s.film.replicates)) {
          PixelSums sums;
          for (uint32_t index = pass.begin; index < pass.end; ++index) {
            const PathRecord path = prepared.replay({x, y, index * s.film.replicates + replicate});
            EXPECT_EQ(path.replicate, replicate);
            EXPECT_EQ(path.index, index);
            expect_same_light(sum_of_contributions(path), path.sample, where);
            lit += is_black(path.sample.emission + path.sample.direct + path.sample.indirect) ? 0 : 1;
            PixelSample exposed = path.sample;
            InvalidSamples none;
            admit(path.id, s.film.sensor, exposed, none);
            sums.add(exposed);
          }
          again.add(x, y, replicate, sums);
        }
        if (testing::Test::HasFailure()) return;
      }
    }
  EXPECT_GT(lit, 20u);
  expect_same_bits(finished.film, again);
}

RenderOverrides small(const std::string& mode) {
  RenderOverrides o;
  o.size = {14, 10};
  o.spp = 6, o.replicates = 2;
  o.seed = 9;
  o.threads = 2;
  o.set = {{"integrator.mode", mode}};
  return o;
}

TEST(Replay, TellsTheImageBitForBitInEveryMode) {
  for (const char* scene : {"conductor_box", "glass_caustic", "lamps", "sky_instances", "textured_room"})
    for (const char* mode : {"mis", "next_event", "naive"}) {
      SCOPED_TRACE(mode);
      expect_replays(fmt::format("tests/scenes/agree/{}.pbrt", scene), small(mode));
    }
}

TEST(Replay, GoesThroughTheFilmsSensor) {
  RenderOverrides o = small("mis");
  o.set = {{"film.iso", "300"}, {"film.whitebalance", "4000"}, {"film.maxcomponentvalue", "0.5"}};
  expect_replays("tests/scenes/agree/lamps.pbrt", o);
}

TEST(Replay, FollowsCropReplicatesSamplerAndComponents) {
  RenderOverrides o = small("mis");
  o.crop = PixelBounds{3, 2, 9, 8};
  o.replicates = 3;
  o.sampler = "independent";
  o.set = {{"integrator.components", "indirect"}, {"integrator.maxdepth", "9"}};
  expect_replays("tests/scenes/agree/sky_instances.pbrt", o);
}

// The numbers behind a word of the table, each "(r, g, b)".
std::vector<Spectrum> numbers_after(const std::string& text, const std::string& word) {
  std::vector<Spectrum> found;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    float r = 0, g = 0, b = 0;
    EXPECT_EQ(std::sscanf(text.c_str() + text.find('(', at), "(%f, %f, %f)", &r, &g, &b), 3) << text;
    found.push_back(Spectrum::rgb(r, g, b));
  }
  return found;
}

TEST(Replay, ThePrintedContributionsAddUpToThePrintedSum) {
  Prepared prepared("tests/scenes/agree/glass_caustic.pbrt", small("mis"));
  size_t contributions = 0;
  for (int x = 0; x < 14; ++x) {
    const PathRecord path = prepared.replay({x, 6, 5});
    const std::string text = replay_text(path, prepared.scene());
    const auto json = nlohmann::json::parse(replay_json(path, prepared.scene()));
    for (const std::string component : {"emission", "direct", "indirect"}) {
      Spectrum sum, json_sum;
      for (const Spectrum& c : numbers_after(text, "+" + component)) sum += c, ++contributions;
      const auto add = [&](const nlohmann::json& part) {
        if (part["component"] != component || part["contribution"].is_null()) return;
        const auto& c = part["contribution"];
        json_sum += Spectrum::rgb(c[0], c[1], c[2]);
      };
      for (const auto& vertex : json["vertices"]) {
        if (vertex.contains("emission"))
          for (const auto& emission : vertex["emission"]) add(emission);
        if (vertex.contains("light")) add(vertex["light"]);
      }
      const std::vector<Spectrum> printed = numbers_after(text.substr(text.find("\nsum ")), " " + component);
      ASSERT_EQ(printed.size(), 1u) << text;
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(float_bits(sum[i]), float_bits(printed[0][i])) << text;
        EXPECT_EQ(float_bits(json_sum[i]), float_bits(printed[0][i])) << text;
        EXPECT_EQ(json["sum"][component][static_cast<size_t>(i)], printed[0][i]);
      }
    }
    const Received received = received_by_film(path, prepared.scene());
    PixelSums sums;
    EXPECT_EQ(sums.add(path.sample), received.luminance);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(json["received"]["rgb"][i], received.rgb[i]);
    EXPECT_EQ(json["valid"], true);
  }
  EXPECT_GT(contributions, 20u);
}

constexpr const char* kScene = R"(Film "rgb" "integer xresolution" 20 "integer yresolution" 20
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.5 0.5 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 90 90 90 ]
  Translate 0 3 -2
  Shape "sphere" "float radius" 0.5
AttributeEnd
MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [ 0.9 0.1 0.1 ]
MakeNamedMaterial "blue" "string type" "diffuse" "rgb reflectance" [ 0.1 0.1 0.9 ]
MakeNamedMaterial "both" "string type" "mix" "string materials" [ "red" "blue" ]
NamedMaterial "both"
Translate 7 0 0
Translate -7 0 0
Shape "sphere"
)";

TEST(Replay, NamesWhatThePathMeets) {
  Diagnostics diagnostics;
  RenderOverrides o;
  o.spp = 64, o.replicates = 2;
  const auto prepared = prepare_render(read_pbrt_text(kScene, "ball.pbrt", ".", diagnostics), o, diagnostics);
  ASSERT_TRUE(prepared) << diagnostics.format_all();
  const ReplayedScene in{*prepared->compiled.scene, prepared->compiled.info->names, diagnostics.sources(),
                         prepared->settings.film.sensor};
  size_t red = 0, blue = 0, lamp = 0, sky = 0;
  for (uint32_t n = 0; n < 64; ++n) {
    PathRecord path;
    ASSERT_TRUE(prepared->integrator->replay({10, 4, n}, path));
    ASSERT_TRUE(path.vertices[0].on_surface);
    const std::string text = replay_text(path, in), line = replay_line(path, in);
    EXPECT_NE(text.find("sphere, ball.pbrt:17"), std::string::npos) << text;
    red += text.find("red (diffuse), ball.pbrt:11") != std::string::npos;
    blue += text.find("blue (diffuse), ball.pbrt:12") != std::string::npos;
    lamp += text.find("area light, ball.pbrt:7") != std::string::npos &&
            line.find("area light (light") != std::string::npos;
    sky += text.find("infinite, ball.pbrt:5") != std::string::npos && line.find("> infinite") != std::string::npos;
    EXPECT_EQ(line.find("mix"), std::string::npos) << line;
    EXPECT_NE(text.find("end         it met no surface"), std::string::npos) << text;
  }
  EXPECT_EQ(red + blue, 64u);
  EXPECT_GT(red, 10u);
  EXPECT_GT(blue, 10u);
  EXPECT_GT(lamp, 10u);
  EXPECT_GT(sky, 3u);
}

// A lamp so bright and close to the ball that no float can hold what arrives there.
constexpr const char* kTooBright = R"(Film "rgb" "integer xresolution" 20 "integer yresolution" 20
Sampler "independent" "integer pixelsamples" 4
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "point" "rgb I" [ 1e37 1e37 1e37 ] "point3 from" [ 0 0 -1.05 ]
Shape "sphere"
)";

TEST(Replay, ShowsInvalidSamplesAsTheyAre) {
  Diagnostics diagnostics;
  auto prepared = prepare_render(read_pbrt_text(kTooBright, "bright.pbrt", ".", diagnostics), {}, diagnostics);
  ASSERT_TRUE(prepared) << diagnostics.format_all();
  RenderObserver nobody;
  const FinishedRender finished = run_render(*prepared, nobody);
  const InvalidSamples& invalid = finished.result.invalid;
  EXPECT_GT(invalid.infinite, 5u);
  EXPECT_EQ(invalid.total(), invalid.infinite);
  EXPECT_EQ(invalid_text(invalid), fmt::format("{} infinite", invalid.infinite));
  ASSERT_TRUE(invalid.first);
  PathRecord path;
  ASSERT_TRUE(prepared->integrator->replay(*invalid.first, path));
  EXPECT_FALSE(is_sound(path.sample));
  const ReplayedScene in{*prepared->compiled.scene, prepared->compiled.info->names, diagnostics.sources(),
                         prepared->settings.film.sensor};
  EXPECT_EQ(received_by_film(path, in).rgb, (std::array<double, 3>{}));
  const std::string text = replay_text(path, in);
  EXPECT_NE(text.find("direct   (inf, inf, inf)"), std::string::npos) << text;
  EXPECT_NE(text.find("the sample is invalid"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(replay_json(path, in));
  EXPECT_EQ(json["sum"]["direct"][0], "Infinity");
  EXPECT_EQ(json["valid"], false);

  const LayeredImage image = finished_image(*prepared, finished);
  for (const float v : image.pixels) EXPECT_TRUE(std::isfinite(v));
  EXPECT_EQ(std::get<std::string>(*image.find_metadata("etendue:invalid_samples")), invalid_text(invalid));
  const std::string command = std::get<std::string>(*image.find_metadata("etendue:invalid_replay"));
  EXPECT_NE(command.find(fmt::format("bright.pbrt --pixel {},{} --sample {}", invalid.first->x, invalid.first->y,
                                     invalid.first->number)),
            std::string::npos)
      << command;
}

TEST(Provenance, ComesBackFromTheFile) {
  const TempFolder folder;
  RenderOverrides o;
  o.size = {40, 30};
  o.spp = 16;
  o.seed = 12345678901234567890u;
  o.replicates = 4;
  o.sampler = "independent";
  o.set = {{"integrator.mode", "naive"}, {"film.iso", "250"}, {"film.filename", "it's a name.exr"}};
  Prepared prepared("tests/scenes/agree/lamps.pbrt", o);
  const FinishedRender finished = prepared.run();
  const auto path = folder.path() / "a.exr";
  ASSERT_EQ(write_layers(path, finished_image(*prepared.render, finished)), "");
  const LayersResult read = read_layers(path);
  ASSERT_TRUE(read.image) << read.error;
  const std::optional<Provenance> p = read_provenance(*read.image);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->scene, source_path("tests/scenes/agree/lamps.pbrt"));
  EXPECT_EQ(p->scene_hash, prepared.render->scene_hash);
  EXPECT_EQ(p->options, (std::vector<std::string>{"--size", "40x30", "--spp", "16", "--replicates", "4", "--seed",
                                                  "12345678901234567890", "--sampler", "independent", "--set",
                                                  "integrator.mode=naive", "--set", "film.iso=250", "--set",
                                                  "film.filename=it's a name.exr"}));
  const std::vector<SampleStrength> strongest = strongest_samples(finished.film, kStrongestKept);
  ASSERT_EQ(p->strongest.size(), strongest.size());
  ASSERT_EQ(strongest.size(), kStrongestKept);
  for (size_t i = 0; i < strongest.size(); ++i) {
    EXPECT_EQ(p->strongest[i].id, strongest[i].id);
    EXPECT_EQ(float_bits(p->strongest[i].luminance), float_bits(strongest[i].luminance));
    EXPECT_NEAR(p->strongest[i].share, strongest[i].share, 1e-5 * std::abs(strongest[i].share));
    const PathRecord replayed = prepared.replay(strongest[i].id);
    EXPECT_EQ(static_cast<float>(received_by_film(replayed, prepared.scene()).luminance), strongest[i].luminance);
  }
  EXPECT_EQ(
      replay_command(*prepared.render, finished.result, {3, 4, 5}),
      fmt::format("etendue replay {} --pixel 3,4 --sample 5 --size 40x30 --spp 16 --replicates 4 --seed "
                  "12345678901234567890 --sampler independent --set integrator.mode=naive --set film.iso=250 --set "
                  "'film.filename=it'\\''s a name.exr'",
                  source_path("tests/scenes/agree/lamps.pbrt").string()));
  EXPECT_FALSE(read_provenance(LayeredImage()));
}

TEST(Provenance, WithoutANumberOfSamplesTheCommandNamesOne) {
  RenderOverrides o;
  o.size = {8, 6};
  o.error = 0.5;
  o.replicates = 3;
  Prepared prepared("tests/scenes/agree/lamps.pbrt", o);
  RenderResult result;
  result.spp = 21;
  const auto has = [&](const std::string& option) {
    const std::string command = replay_command(*prepared.render, result, {0, 0, 0});
    EXPECT_NE(command.find(option + " "), std::string::npos) << command;
  };
  has("--spp 21");
  result.unequal = true;  // the next pass was begun: 7 samples of each replicate more
  has("--spp 42");
}

TEST(Provenance, LimitsThatWereRaisedAreKept) {
  Limits limits;
  EXPECT_EQ(changed_limits(limits), std::vector<std::string>{});
  ASSERT_EQ(set_limit(limits, "unpacked=2G"), "");
  ASSERT_EQ(set_limit(limits, "repeated=1000"), "");
  ASSERT_EQ(set_limit(limits, "copies=5000000"), "");
  EXPECT_EQ(changed_limits(limits), (std::vector<std::string>{"copies=5000000", "repeated=1000", "unpacked=2G"}));
  Diagnostics diagnostics(false, limits);
  const auto prepared =
      prepare_render(read_pbrt(source_path("tests/scenes/agree/lamps.pbrt"), diagnostics), {}, diagnostics);
  ASSERT_TRUE(prepared) << diagnostics.format_all();
  const std::string command = replay_command(*prepared, {}, {0, 0, 0});
  EXPECT_TRUE(command.ends_with(" --limit copies=5000000 --limit repeated=1000 --limit unpacked=2G")) << command;
}

TEST(Provenance, TheHashKnowsTheSceneAndWhatItIncludes) {
  const TempFolder folder;
  const auto hash = [&folder](const std::string& scene, const std::string& part) {
    folder.write("part.pbrt", part);
    Diagnostics diagnostics;
    const SceneDescription description = read_pbrt(folder.write("scene.pbrt", scene), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
    return hash_scene(description, diagnostics.sources());
  };
  const std::string scene = "WorldBegin\nInclude \"part.pbrt\"\n", part = "Shape \"sphere\"\n";
  const std::string first = hash(scene, part);
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(first, hash(scene, part));
  EXPECT_NE(first, hash(scene + "\n", part));
  EXPECT_NE(first, hash(scene, part + "# changed\n"));
  // A mesh is a scene by itself, of which readers keep no text.
  SceneDescription mesh;
  mesh.file = folder.write("a.off", "OFF 1");
  const std::string one = hash_scene(mesh, Sources());
  folder.write("a.off", "OFF 2");
  EXPECT_NE(one, hash_scene(mesh, Sources()));
}

}  // namespace
}  // namespace etd
