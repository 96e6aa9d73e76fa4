#include <gtest/gtest.h>

#include <cmath>

#include "params/declaration.h"
#include "params/describe.h"

namespace etd {
namespace {

ModelDecl ball() {
  return {Family::kShape,
          "ball",
          "A ball.",
          {{.name = "radius",
            .type = ParamType::kFloat,
            .default_value = 1.0,
            .min = 0,
            .above_min = true,
            .unit = "m",
            .doc = "Radius."},
           {.name = "count", .type = ParamType::kInteger, .default_value = 3, .min = 0, .max = 10, .clamp = true},
           {.name = "P", .type = ParamType::kPoint3, .array = true},
           {.name = "color", .type = ParamType::kSpectrum, .default_value = 0.5, .min = 0, .max = 1},
           {.name = "bump", .type = ParamType::kFloatTexture, .default_value = 0.0},
           {.name = "mode", .type = ParamType::kString, .default_value = "fast", .choices = {"fast", "exact"}},
           {.name = "hollow", .type = ParamType::kBool, .default_value = true}}};
}

Param numbers(std::string name, ParamKind kind, std::vector<double> values) {
  Param p;
  p.name = std::move(name), p.kind = kind, p.numbers = std::move(values);
  return p;
}
Param integers(std::string name, std::vector<int32_t> values) {
  Param p;
  p.name = std::move(name), p.kind = ParamKind::kInteger, p.integers = std::move(values);
  return p;
}
Param strings(std::string name, ParamKind kind, std::vector<std::string> values) {
  Param p;
  p.name = std::move(name), p.kind = kind, p.strings = std::move(values);
  return p;
}

// All messages and hints that checking one parameter gives, in one string.
std::string check(Param p) {
  Diagnostics d;
  check_params(ball(), {"ball", {std::move(p)}, {}}, d);
  return d.format_all();
}

TEST(Params, AcceptsWhatIsDeclared) {
  EXPECT_EQ(check(numbers("radius", ParamKind::kFloat, {2})), "");
  EXPECT_EQ(check(numbers("P", ParamKind::kPoint3, {1, 2, 3, 4, 5, 6})), "");
  EXPECT_EQ(check(numbers("P", ParamKind::kPoint3, {})), "");
  EXPECT_EQ(check(numbers("color", ParamKind::kRgb, {0, 0.5, 1})), "");
  EXPECT_EQ(check(numbers("color", ParamKind::kFloat, {0.5})), "");
  EXPECT_EQ(check(numbers("color", ParamKind::kBlackbody, {6500})), "");
  EXPECT_EQ(check(numbers("color", ParamKind::kSpectrum, {400, 0.1, 700, 0.9})), "");
  EXPECT_EQ(check(strings("color", ParamKind::kSpectrum, {"metal-Cu-eta"})), "");
  EXPECT_EQ(check(strings("bump", ParamKind::kTexture, {"waves"})), "");
}

TEST(Params, UnknownParametersAreErrorsWithTheNearestName) {
  EXPECT_EQ(check(numbers("raduis", ParamKind::kFloat, {1})),
            "error: shape \"ball\" has no parameter \"raduis\"\n"
            "   did you mean \"radius\"? \"ball\" takes: radius, count, P, color, bump, mode, hollow\n1 error\n");
  EXPECT_EQ(check(numbers("zzz", ParamKind::kFloat, {1})),
            "error: shape \"ball\" has no parameter \"zzz\"\n"
            "   \"ball\" takes: radius, count, P, color, bump, mode, hollow\n1 error\n");
}

TEST(Params, TypesMustMatchExactly) {
  EXPECT_EQ(check(integers("radius", {1})),
            "error: parameter \"radius\" of shape \"ball\" is of type float, not integer\n"
            "   write \"float radius\" instead of \"integer radius\"\n1 error\n");
  EXPECT_EQ(
      check(strings("color", ParamKind::kString, {"red"})),
      "error: parameter \"color\" of shape \"ball\" is of type spectrum, not string\n"
      "   write \"rgb color\", \"spectrum color\", \"blackbody color\" or \"float color\" instead of \"string color\"\n"
      "1 error\n");
}

TEST(Params, CountsAreChecked) {
  EXPECT_EQ(check(numbers("color", ParamKind::kRgb, {1, 1, 1, 1})),
            "error: parameter \"color\" of shape \"ball\" takes 3 numbers, not 4\n1 error\n");
  EXPECT_EQ(check(numbers("radius", ParamKind::kFloat, {})),
            "error: parameter \"radius\" of shape \"ball\" takes 1 number, not 0\n1 error\n");
  EXPECT_EQ(check(numbers("P", ParamKind::kPoint3, {1, 2, 3, 4})),
            "error: parameter \"P\" of shape \"ball\" takes a multiple of 3 numbers, not 4\n1 error\n");
  EXPECT_NE(
      check(numbers("color", ParamKind::kSpectrum, {400, 1, 500})).find("pairs of a wavelength and a value, not 3"),
      std::string::npos);
  EXPECT_NE(check(numbers("color", ParamKind::kSpectrum, {500, 1, 400, 1})).find("must increase: 400 after 500"),
            std::string::npos);
}

TEST(Params, ValuesMustBeFiniteAndInRange) {
  EXPECT_EQ(
      check(numbers("P", ParamKind::kPoint3, {0, NAN, 0})),
      "error: value 2 of parameter \"P\" of shape \"ball\" is not a number\n   every number must be finite\n1 error\n");
  EXPECT_NE(check(numbers("radius", ParamKind::kFloat, {INFINITY})).find("is infinite"), std::string::npos);
  EXPECT_EQ(check(numbers("radius", ParamKind::kFloat, {0})),
            "error: parameter \"radius\" of shape \"ball\" is 0, out of range\n   valid: > 0\n1 error\n");
  EXPECT_NE(check(numbers("color", ParamKind::kRgb, {0, 0, 1.5})).find("is 1.5, out of range"), std::string::npos);
  EXPECT_NE(check(numbers("color", ParamKind::kBlackbody, {-1})).find("temperature"), std::string::npos);
  EXPECT_EQ(check(strings("mode", ParamKind::kString, {"exakt"})),
            "error: parameter \"mode\" of shape \"ball\" cannot be \"exakt\"\n"
            "   did you mean \"exact\"? valid: \"fast\", \"exact\"\n1 error\n");
  EXPECT_EQ(check(integers("count", {11})),
            "warning: parameter \"count\" of shape \"ball\" is 11, clamped\n   valid: 0 to 10, clamped\n1 warning\n");
}

TEST(Params, DuplicatesAndMissingOnesAreReported) {
  ModelDecl decl = ball();
  decl.params[2].required = true;
  decl.params[2].doc = "The points.";
  Diagnostics d;
  check_params(decl, {"ball", {integers("count", {1}), integers("count", {2})}, {}}, d);
  EXPECT_EQ(d.format_all(),
            "error: parameter \"count\" of shape \"ball\" is given twice\n"
            "error: shape \"ball\" needs the parameter \"P\"\n   point3: The points.\n2 errors\n");
}

TEST(Params, ReaderGivesValuesOrDefaults) {
  const ModelDecl decl = ball();
  Diagnostics d;
  const ModelUse use{"ball",
                     {integers("count", {99}), numbers("radius", ParamKind::kFloat, {-1}),
                      numbers("P", ParamKind::kPoint3, {1, 2, 3})},
                     {}};
  const ParamReader reader(decl, use, d);
  EXPECT_EQ(reader.integer("count"), 10);
  EXPECT_EQ(reader.number("radius"), 1.0);  // the wrong value was reported; the default stands in
  EXPECT_EQ(reader.numbers("P"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(reader.string("mode"), "fast");
  EXPECT_TRUE(reader.boolean("hollow"));
  EXPECT_EQ(reader.given("color"), nullptr);
  EXPECT_EQ(reader.number("bump"), 0.0);
  EXPECT_EQ(reader.given("P"), &use.params[2]);
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";  // other tests may have started threads
  EXPECT_DEATH(reader.number("nothing"), "is read but not declared");
  EXPECT_DEATH(reader.number("mode"), "another type");
}

TEST(Params, DescribeShowsEverythingDeclared) {
  const std::string text = describe(ball());
  EXPECT_NE(text.find("shape \"ball\"\n  A ball.\n"), std::string::npos);
  EXPECT_NE(text.find("radius  float          default 1; > 0; in m"), std::string::npos) << text;
  EXPECT_NE(text.find("P       point3[]       no default"), std::string::npos) << text;
  EXPECT_NE(text.find("default \"fast\"; \"fast\", \"exact\""), std::string::npos) << text;
}

TEST(Diagnostics, ShowTheLineWithACaret) {
  Diagnostics d;
  const int32_t file = d.sources().add("scene.pbrt", "Material \"diffuse\"\n\t\"rgb reflectence\" [0.5]\r\n");
  d.error({file, 2, 2, 17}, "wrong", "first hint\nsecond hint");
  EXPECT_EQ(d.format_all(),
            "scene.pbrt:2:2: error: wrong\n"
            "    2 |  \"rgb reflectence\" [0.5]\n"
            "      |  ^~~~~~~~~~~~~~~~~\n"
            "   first hint\n   second hint\n1 error\n");
}

TEST(Diagnostics, PlacesOfOtherDiagnosticsAreLeftOut) {
  Diagnostics other, diagnostics;
  const int32_t file = other.sources().add("a.pbrt", "Shape\n");
  diagnostics.warning({file, 1, 1}, "a message");
  EXPECT_EQ(diagnostics.format_all(), "warning: a message\n1 warning\n");
}

TEST(Diagnostics, LongLinesAreCutAroundTheCaret) {
  Diagnostics d;
  const std::string line = std::string(3000000, 'a') + "X" + std::string(3000000, 'b');
  const int32_t file = d.sources().add("mesh.pbrt", line);
  d.error({file, 1, 3000001, 1}, "here");
  const std::string text = d.format_all();
  EXPECT_LT(text.size(), 350u);
  const size_t excerpt = text.find("    1 | "), marker = text.find("      | ");
  EXPECT_EQ(text[excerpt + (text.find('^') - marker)], 'X');
}

TEST(Diagnostics, CaretsCountCharactersAndBadBytesAreHarmless) {
  Diagnostics d;
  const int32_t file = d.sources().add("u.pbrt", "\xc3\xa4\xff\x01 Shape");
  d.error({file, 1, 6, 5}, "x");
  EXPECT_EQ(d.format_all(), "u.pbrt:1:6: error: x\n    1 | \xc3\xa4?? Shape\n      |     ^~~~~\n1 error\n");
  d.error({file, 7, 99, 5}, "beyond the end");
  EXPECT_NE(d.format_all().find("u.pbrt:7:99"), std::string::npos);
}

TEST(Diagnostics, SortedNotesOnceUnsupportedByMode) {
  Diagnostics d;
  const int32_t file = d.sources().add("a", "1\n2\n3\n");
  d.error({file, 3, 1, 1}, "third");
  d.unsupported({file, 1, 1, 1}, "material \"hair\"", "a black diffuse material");
  d.note({file, 2, 1, 1}, "once");
  d.note({file, 3, 1, 1}, "once");
  d.error({file, 3, 1, 1}, "third");
  EXPECT_EQ(d.format_all(),
            "a:1:1: error: material \"hair\" is not supported yet\n    1 | 1\n      | ^\n"
            "   --allow-unsupported renders with: a black diffuse material\n"
            "a:2:1: note: once\n    2 | 2\n      | ^\n"
            "a:3:1: error: third\n    3 | 3\n      | ^\n"
            "2 errors (1 unsupported use)\n");
  Diagnostics allowing(true);
  allowing.unsupported({}, "material \"hair\"", "a black diffuse material");
  EXPECT_FALSE(allowing.has_errors());
  EXPECT_EQ(allowing.format_all(),
            "warning: material \"hair\" is not supported yet\n   rendered with: a black diffuse material\n1 warning\n");
}

TEST(Diagnostics, NearestNameForgivesATypo) {
  const std::vector<std::string_view> names{"reflectance", "roughness", "L", "fov"};
  EXPECT_EQ(nearest_name("reflectence", names), "reflectance");
  EXPECT_EQ(nearest_name("roughnses", names), "roughness");
  EXPECT_EQ(nearest_name("l", names), "L");
  EXPECT_EQ(nearest_name("fvo", names), "fov");
  EXPECT_EQ(nearest_name("zap", names), "");
  EXPECT_EQ(nearest_name("", names), "");
}

}  // namespace
}  // namespace etd
