#include "scene/place.h"

#include <algorithm>
#include <utility>

#include "scene/registry.h"

namespace etd {

namespace {

// Says where an object is: local is its part behind the last transform that moves.
struct Place {
  TransformPath path;  // to the world; moves, or is empty
  Transform local;
  int group = -1;  // of what stands still on this path, once there is something
  SourceLoc loc;
  int object = -1;  // whose part it is; -1: none yet

  Place then(const TransformPair& t, SourceLoc at) const {
    Place inner = *this;
    inner.loc = at;
    inner.local = t.is_moving() ? Transform() : local * t.start;
    if (!t.is_moving()) return inner;
    inner.path = full().then(t);
    inner.group = -1;
    return inner;
  }
  TransformPath full() const { return local.is_identity() ? path : path.then(local); }
};

class Placer {
 public:
  Placer(const SceneDescription& description, Diagnostics& diagnostics)
      : description_(description), diagnostics_(diagnostics), placed_(description.objects.size()) {
    most_ = diagnostics.limits().copies + description.shapes.size() + description.instances.size();
    for (const ObjectDesc& object : description.objects) {
      most_ += object.shapes.size() + object.instances.size();
      emits_.push_back(emits(object));
    }
  }

  PlacedShapes run() {
    add(description_.shapes, description_.instances, {});
    // Objects only contain earlier ones, so going backwards every place is known before its object is reached.
    for (size_t o = description_.objects.size(); o-- > 0 && !too_many_;) {
      const ObjectDesc& object = description_.objects[o];
      if (placed_[o].size() > 1 && !emits_[o]) {
        ShapeGroup group{{}, instances(placed_[o], Transform(), Transform()), true};
        expand(object, Transform(), placed_[o], group);
        out_.groups.push_back(std::move(group));
      } else {
        for (const Place& place : placed_[o]) add(object.shapes, object.instances, place);
      }
    }
    std::reverse(out_.groups.begin(), out_.groups.end());
    return std::move(out_);
  }

 private:
  // The parts of the object have been asked before.
  bool emits(const ObjectDesc& object) const {
    const auto child_emits = [&](const InstanceDesc& i) { return emits_[static_cast<size_t>(i.object)]; };
    return std::any_of(object.shapes.begin(), object.shapes.end(),
                       [](const ShapeDesc& s) { return s.area_light >= 0; }) ||
           std::any_of(object.instances.begin(), object.instances.end(), child_emits);
  }

  // Counts a shape or an instance; one on a long path takes the memory of several. False, and reported the first time,
  // when there are too many.
  bool count(const TransformPath& path, SourceLoc loc) {
    made_ += 1 + path.length() / 4;
    if (made_ > most_ && !std::exchange(too_many_, true))
      diagnostics_.error(
          loc, "instances of objects that contain instances make too many copies",
          "shapes and instances that the scene does not list: " + limit_text(diagnostics_.limits(), &Limits::copies));
    return !too_many_;
  }

  // The content of what is in one place.
  void add(const std::vector<ShapeDesc>& shapes, const std::vector<InstanceDesc>& instances, Place place) {
    for (const ShapeDesc& s : shapes) {
      if (!count(place.path, s.use.loc)) return;
      const int object = place.object >= 0 ? place.object : object_of(s);
      if (s.to_world.is_moving()) {
        Place own = place.then(s.to_world, s.use.loc);
        add_moving(s, own, object);
      } else if (place.path.moves()) {
        add_moving(s, place, object, s.to_world.start);
      } else {
        out_.world.push_back({&s, place.local * s.to_world.start, object});
      }
    }
    for (const InstanceDesc& i : instances) {
      Place inner = place.then(i.to_world, i.loc);
      if (inner.object < 0) {
        inner.object = static_cast<int>(out_.objects.size());
        out_.objects.push_back({{"instance", i.loc}, description_.objects[static_cast<size_t>(i.object)].name});
      }
      add_place(i, inner);
    }
  }

  void add_place(const InstanceDesc& instance, Place place) {
    if (count(place.path, instance.loc)) placed_[static_cast<size_t>(instance.object)].push_back(std::move(place));
  }

  // A shape of the world is an object of its own, or with the shapes before it that it is a part with.
  int object_of(const ShapeDesc& s) {
    if (s.part == 0) out_.objects.push_back({name_item(Family::kShape, s.use), {}});
    return static_cast<int>(out_.objects.size()) - 1;
  }

  void add_moving(const ShapeDesc& shape, Place& place, int object, const Transform& to_object = Transform()) {
    const Transform size = TransformParts::of(place.path.at(0).matrix()).rest();
    if (place.group < 0) {
      place.group = static_cast<int>(out_.groups.size());
      out_.groups.push_back({{}, {{place.path.then(size.inverse()), place.loc}}, false});
    }
    out_.groups[static_cast<size_t>(place.group)].shapes.push_back({&shape, size * place.local * to_object, object});
  }

  static std::vector<PlacedGroup> instances(const std::vector<Place>& places, const Transform& t,
                                            const TransformPair& inner) {
    std::vector<PlacedGroup> all;
    for (const Place& p : places) all.push_back({p.then(t, p.loc).then(inner, p.loc).full(), p.loc, p.object});
    return all;
  }

  // All that stands still in an object and in the objects in it goes to the group; what moves there gets its own.
  void expand(const ObjectDesc& object, const Transform& t, const std::vector<Place>& places, ShapeGroup& group) {
    for (const ShapeDesc& s : object.shapes) {
      if (!count({}, s.use.loc)) return;
      if (s.to_world.is_moving()) {
        made_ += places.size();
        out_.groups.push_back({{{&s, Transform()}}, instances(places, t, s.to_world), true});
      } else {
        group.shapes.push_back({&s, t * s.to_world.start});
      }
    }
    for (const InstanceDesc& i : object.instances) {
      if (!count({}, i.loc)) return;
      if (!i.to_world.is_moving())
        expand(description_.objects[static_cast<size_t>(i.object)], t * i.to_world.start, places, group);
      else
        for (const Place& p : places) add_place(i, p.then(t, p.loc).then(i.to_world, i.loc));
    }
  }

  const SceneDescription& description_;
  Diagnostics& diagnostics_;
  std::vector<bool> emits_;                 // by object
  std::vector<std::vector<Place>> placed_;  // by object
  PlacedShapes out_;
  uint64_t made_ = 0, most_ = 0;  // shapes and instances
  bool too_many_ = false;
};

}  // namespace

PlacedShapes place_shapes(const SceneDescription& description, Diagnostics& diagnostics) {
  return Placer(description, diagnostics).run();
}

}  // namespace etd
