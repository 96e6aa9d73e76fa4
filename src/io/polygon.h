// Polygons of any shape as triangles. Modelling programs write faces with notches and holes, and a fan of triangles
// around one corner covers what is no part of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace etd {

// Cuts polygons, one after the other in the same memory.
//
// In the plane of the polygon, one corner after the other is cut off as an ear, a triangle with its two neighbours that
// holds nothing else of the polygon (Meisters 1975, "Polygons have ears"). That all triangles have the orientation of
// the polygon makes the cut right: together they then cover each point as often as the polygon winds around it. A
// convex polygon becomes a fan around its first corner, in linear time; others take about n log n, at worst n^1.5.
class PolygonCutter {
 public:
  // Appends the triangles of the polygon whose corners are positions[corners[0]], positions[corners[1]], ..., at most
  // two fewer than there are corners. False: the polygon crosses itself, and what its triangles cover is a guess. It
  // may touch itself, as one does that goes to a hole and back along a bridge. The positions are finite.
  bool cut(const std::vector<Point3d>& positions, std::span<const uint32_t> corners,
           std::vector<std::array<uint32_t, 3>>& triangles);

 private:
  // Corners are in the plane, scaled to a size of about 1, so that the polygon winds counterclockwise.
  struct Corner {
    double x = 0, y = 0;
    uint32_t prev = 0, next = 0;
    uint32_t changes = 0;  // of its neighbours
    bool reflex = false;   // or straight, and not cut off: one of these lies in every triangle that is no ear
  };
  // A line through two corners, and on which side of it points are: 1 to the left, 0 within rounding.
  struct Edge {
    double x, y, dx, dy;
    double side(double px, double py) const { return dx * (py - y) - dy * (px - x); }
  };
  struct Triangle {
    std::array<Edge, 3> edges;                                             // the last one is the cut
    double noise;                                                          // what rounding may make of a side that is 0
    double low[2], high[2];                                                // of the box around it
    double area() const { return edges[0].side(edges[2].x, edges[2].y); }  // twice
  };
  // A node of a balanced tree over reflex corners: a box around them, and how many are left.
  struct Node {
    double low[2], high[2];
    uint32_t left;
  };
  struct Candidate {
    uint32_t corner, changes;
  };
  // What a corner must be to be cut off: asked of all that wait before anything weaker is asked of one. A polygon that
  // neither crosses nor touches itself needs ears alone. Spikes go first, since a polygon that touches itself may come
  // to be one that is all edges, and where these turn one way they look like ears.
  enum Level { kSpike, kEar, kFlat, kTouchedEar, kConvex, kAny, kLevels };

  enum class Outline { kConvex, kOther, kTwisted };

  bool project(const std::vector<Point3d>& positions, std::span<const uint32_t> corners);
  Edge edge(uint32_t from, uint32_t to) const;
  Triangle triangle_at(uint32_t corner) const;
  // Returns the turn of the triangle there: 1 for a convex corner, -1 for a reflex one, 0 for none within rounding.
  int turn(uint32_t corner) const;
  Outline outline() const;
  bool is_spike(uint32_t corner) const;
  bool edges_cross();
  void build_tree();
  void build_node(size_t node, size_t begin, size_t end);
  // Whether a reflex corner lies in the triangle, or on the cut if that counts.
  bool holds_corner(const Triangle& t, bool with_cut, size_t node, size_t begin, size_t end) const;
  bool allows(uint32_t corner, Level level) const;
  void set_reflex(uint32_t corner, bool reflex);
  bool next_candidate(Level& level, uint32_t& corner);

  std::vector<Corner> corners_;
  double tolerance_ = 0;           // how far positions that were rounded to float may be off
  std::vector<uint32_t> in_tree_;  // the reflex corners in the order of the tree's leaves; edges by their low end
  std::vector<uint32_t> leaf_of_;  // by corner: its node
  std::vector<Node> nodes_;        // the children of node i are 2 i + 1 and 2 i + 2
  std::array<std::vector<Candidate>, kLevels> waiting_;
  std::array<size_t, kLevels> first_{};  // that still waits
};

}  // namespace etd
