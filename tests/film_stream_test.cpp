#include "render/film_stream.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "noise_integrator.h"
#include "render/driver.h"

namespace etd {
namespace {

using namespace std::chrono_literals;

const FilmSettings kFilm{.width = 20, .height = 12, .crop = {2, 1, 18, 12}, .replicates = 2};

struct Received {
  std::vector<LayeredImage> pictures;
  int problems = 0;
};

RenderResult render_watched(Film& film, RenderObserver& observer, uint32_t spp) {
  NoiseIntegrator integrator(kFilm, 4);
  return render(integrator, film, {.spp = spp, .threads = 3}, observer);
}

TEST(FilmStream, ShowsTheFirstPassAndTheEnd) {
  Received got;
  Film film(kFilm);
  {
    FilmStream stream([&](const LayeredImage& p) { return got.pictures.push_back(p), std::string(); },
                      [&](const std::string&) { ++got.problems; }, 1h);
    render_watched(film, stream, 64);
    stream.finish(film);
  }
  ASSERT_EQ(got.pictures.size(), 2u);
  EXPECT_EQ(got.problems, 0);
  Film first(kFilm);
  RenderObserver nobody;
  render_watched(first, nobody, 2);
  EXPECT_EQ(got.pictures[0].pixels, make_picture(first).pixels);
  EXPECT_EQ(got.pictures[1].pixels, make_picture(film).pixels);
}

TEST(FilmStream, PicturesAreTheLayersOfTheFile) {
  Film film(kFilm);
  RenderObserver nobody;
  render_watched(film, nobody, 8);
  const LayeredImage picture = make_picture(film), layers = make_layers(film);
  for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(picture.plane(channel), layers.plane(channel));
  EXPECT_EQ(picture.x, layers.x);
  EXPECT_EQ(picture.full_height, layers.full_height);
}

TEST(FilmStream, WatchingAllTheTimeChangesNoBit) {
  Film plain(kFilm), watched(kFilm);
  RenderObserver nobody;
  render_watched(plain, nobody, 64);
  std::atomic<int> pictures{0};
  {
    FilmStream stream([&](const LayeredImage&) { return ++pictures, std::string(); }, [](const std::string&) {}, 0ms);
    render_watched(watched, stream, 64);
    stream.finish(watched);
  }
  EXPECT_GE(pictures, 2);
  EXPECT_EQ(make_layers(plain).pixels, make_layers(watched).pixels);
}

TEST(FilmStream, AFailingReceiverIsReportedOnceAndNotAskedAgain) {
  for (const bool throws : {false, true}) {
    int calls = 0;
    std::vector<std::string> problems;
    Film film(kFilm);
    {
      FilmStream stream(
          [&](const LayeredImage&) -> std::string {
            ++calls;
            if (throws) throw std::runtime_error("no room");
            return "no room";
          },
          [&](const std::string& problem) { problems.push_back(problem); }, 0ms);
      EXPECT_EQ(render_watched(film, stream, 64).spp, 64u);
      stream.finish(film);
    }
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(problems, std::vector<std::string>{"no room"});
  }
}

TEST(ObserverList, TellsEverybodyAndShowsTheFilmToThoseWhoWantIt) {
  struct Counter : RenderObserver {
    explicit Counter(bool curious) : wants(curious) {}
    void on_progress(const RenderProgress&) override { ++progress; }
    void on_pass_end(const RenderProgress&) override { ++passes; }
    bool wants_film() const override { return wants; }
    void on_film(const Film&) override { ++films; }
    bool wants;
    std::atomic<int> progress{0};
    int passes = 0, films = 0;
  };
  Counter curious(true), bored(false);
  ObserverList list;
  EXPECT_FALSE(list.wants_film());
  list.add(bored);
  EXPECT_FALSE(list.wants_film());
  list.add(curious);
  EXPECT_TRUE(list.wants_film());
  Film film(kFilm);
  render_watched(film, list, 8);
  EXPECT_EQ(curious.progress, bored.progress);
  EXPECT_GT(curious.progress, 0);
  EXPECT_EQ(curious.passes, 3);
  EXPECT_EQ(bored.passes, 3);
  EXPECT_GT(curious.films, 0);
  EXPECT_EQ(bored.films, 0);
}

}  // namespace
}  // namespace etd
