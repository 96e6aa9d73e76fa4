// Wavefront OBJ: meshes with the materials of the MTL files beside them, as the file gives them.
// Format: Wavefront Technologies, "Advanced Visualizer" appendix B1 (OBJ) and the MTL document of 1995; Pr, Pm and Ke
// as programs write them since.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh.h"

namespace etd {

// An image that a material names, its place relative to the folder of the OBJ file.
struct ObjMap {
  std::filesystem::path file;  // empty: none
  Vec2 scale{1, 1}, offset;    // looked up at offset + scale * uv
  bool clamp = false;          // black outside of the unit square
  double height = 1;           // of a bump map: that of white over black
};

struct ObjMaterial {
  std::string name;
  Vec3 kd{0.8f, 0.8f, 0.8f};  // diffuse reflectance
  Vec3 ks;                    // of gloss
  Vec3 ke;                    // emitted
  double ns = 0;              // exponent of a Phong lobe
  double ni = 1;              // index of refraction
  double d = 1;               // opacity
  int illum = 2;              // which of Wavefront's eleven models of shading
  std::optional<double> pr;   // roughness and
  double pm = 0;              // metalness of the extension that many programs write
  ObjMap map_kd, map_d;
  ObjMap bump;    // heights
  ObjMap normal;  // normals in the frame of u and v, as (n + 1) / 2
};

// The faces that use one material, all groups and objects together.
struct ObjPart {
  std::string material;  // empty: those before any usemtl
  MeshData mesh;         // normals are zero where a corner has none
};

struct ObjResult {
  std::vector<ObjPart> parts;              // in the order of first use; none when there are problems
  std::vector<ObjMaterial> materials;      // of all MTL files that could be read; the last of a name counts
  std::map<std::string, size_t> index_of;  // of the material of a name
  std::vector<std::string> problems;       // as in MeshResult
  std::vector<std::string> notes;

  const ObjMaterial* find(const std::string& name) const;
};

ObjResult read_obj(const std::filesystem::path& path, const Limits& limits = {});
// All faces as one mesh, without materials.
MeshResult read_obj_mesh(const std::filesystem::path& path, const Limits& limits = {});

// Adds the materials of an MTL file. `folder` is its own, relative to that of the OBJ file. Returns why it can't be
// read, or an empty string.
std::string read_mtl(const std::filesystem::path& path, const std::filesystem::path& folder, const Limits& limits,
                     ObjResult& result);

}  // namespace etd
