// Triangles that come nearer to the viewer than their size allows. Barycentrics are floats: on a ground of a thousand
// kilometres they are centimetres to metres apart, under the feet of who stands on it too. Cut into pieces that are the
// smaller the nearer they are, it has the precision of everything else there.
#pragma once

#include "io/mesh.h"
#include "shapes/mesh.h"

namespace etd {

// How many times longer an edge may be than the triangle's distance from the viewer. The error bound of a triangle is 8
// u times its longest edge, u = 2^-24 (shapes/triangle.cpp): at this ratio 2^-13 of the distance, an eighth of a pixel
// of a thousandth.
inline constexpr double kLongestEdge = 256;

// Whether a triangle of the mesh, at any of its motion steps, has an edge longer than `ratio` times its distance from
// the viewer. Those that the viewer sees edge on are not counted.
bool has_coarse_triangles(const Mesh& mesh, Point3d viewer, double ratio = kLongestEdge);

// Judges one triangle.
bool is_coarse_triangle(Point3d a, Point3d b, Point3d c, Point3d viewer, double ratio = kLongestEdge);

// Cuts triangles, and their neighbours where these share an edge that is cut, until none is too long, or those that are
// have become smaller by 2^40. The surface stays the same, with its texture coordinates and interpolated normals
// (those of new vertices are not normalised); `flip_ng` as in Mesh. Of a mesh that does not deform. The first piece of
// a triangle stays in its place in the list.
void cut_coarse_triangles(MeshData& mesh, bool flip_ng, Point3d viewer);

// The distance of a point from a triangle.
double distance_to_triangle(Point3d p, Point3d a, Point3d b, Point3d c);

}  // namespace etd
