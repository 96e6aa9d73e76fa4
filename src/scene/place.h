// Says where the shapes of a description end up: in the world, or in groups that rays meet in a space of their own.
#pragma once

#include <vector>

#include "core/animated_transform.h"
#include "params/diagnostics.h"
#include "scene/description.h"
#include "scene/names.h"

namespace etd {

// A shape of the description under the transform to the space in which rays will meet it.
struct PlacedShape {
  const ShapeDesc* shape;
  Transform to_space;
  int object = -1;  // index into PlacedShapes::objects; -1: that of the instance
};

struct PlacedGroup {
  TransformPath to_world;
  SourceLoc loc;
  int object = -1;  // of shapes that have none
};

// Shapes that instances place in the world.
struct ShapeGroup {
  std::vector<PlacedShape> shapes;
  std::vector<PlacedGroup> instances;
  // Objects without lights that several instances place; otherwise the group is that of one thing that moves.
  bool is_shared = false;
};

struct PlacedShapes {
  std::vector<PlacedShape> world;
  std::vector<ShapeGroup> groups;
  std::vector<SceneNames::Object> objects;
};

// Flattens: what one instance places, or what emits, becomes part of the world, or, where it moves, of a group of its
// own, so that a light is one surface in one place. What stands still in such a group has the size there that it has
// in the world when the motion starts: rigid motions then only turn and translate it. Instances of instances multiply:
// more copies than the limits allow are an error, and what comes back then is incomplete.
PlacedShapes place_shapes(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace etd
