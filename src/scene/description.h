// What a scene file says, as plain data with source locations and no renderer types: the only thing that the format
// readers produce and that compile() consumes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/transform.h"
#include "io/mesh.h"
#include "io/named_images.h"
#include "params/param.h"

namespace etd {

struct TextureDesc {
  std::string name;
  bool is_float = false;  // float and spectrum textures have separate names
  ModelUse use;
  Transform to_world;
};

struct MaterialDesc {
  std::string name;  // empty when the scene gave none
  ModelUse use;
};

struct ShapeDesc {
  ModelUse use;
  TransformPair to_world;  // of an object's shape: to the object's space
  bool reverse_orientation = false;
  int material = -1;    // index into materials; -1: the default diffuse
  int area_light = -1;  // index into area_lights; -1: does not emit
  int part = 0;         // of one thing that is several shapes, which follow each other
  // For a "trianglemesh", which then has no vertices of its own: what a reader took from a file, or what code made.
  std::shared_ptr<const MeshData> mesh = nullptr;
};

struct InstanceDesc {
  int object = -1;         // index into objects
  TransformPair to_world;  // from the object's space
  SourceLoc loc;
};

struct LightDesc {
  ModelUse use;
  TransformPair to_world;  // of an object's light: to the object's space
};

// A group of shapes and lights that instances place in the world; may contain instances of earlier objects.
struct ObjectDesc {
  std::string name;
  std::vector<ShapeDesc> shapes;
  std::vector<LightDesc> lights;
  std::vector<InstanceDesc> instances;
  SourceLoc loc;
};

// How a scene is looked at: what stands before the world, and can be exchanged for that of another file.
struct ViewDescription {
  std::filesystem::path camera_file;  // that file; empty: the scene's own
  std::vector<int32_t> sources;       // the texts that scene and view were read from, as Sources counts them

  // The readers fill these with their format's defaults when the file does not say.
  ModelUse camera, film, filter, sampler, integrator;
  bool filter_textures = true;    // over the footprint of a pixel, where they can be; otherwise at points
  TransformPair camera_to_world;  // a mirroring one is allowed: handedness lives in the camera
  // When what moves is where its two transforms say, and deforming meshes begin and end; before and after, all rests.
  double motion_start = 0, motion_end = 1;  // s
};

struct SceneDescription : ViewDescription {
  std::filesystem::path file;    // of the scene, for messages and metadata
  std::filesystem::path folder;  // that relative file names in it start from

  NamedImages images;  // that are no files
  std::vector<TextureDesc> textures;
  std::vector<MaterialDesc> materials;
  std::vector<ModelUse> area_lights;
  std::vector<ShapeDesc> shapes;
  std::vector<ObjectDesc> objects;
  std::vector<InstanceDesc> instances;
  std::vector<LightDesc> lights;

  // Refers to `images`.
  ImageSource image_source() const { return {folder, &images}; }
};

}  // namespace etd
