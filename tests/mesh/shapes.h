// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lightwell/base/random.h"
#include "lightwell/mesh/mesh.h"
#include "tests/mesh/knot.h"

namespace lightwell {

/// Adds triangles of corners that are nobody else's.
inline void add_triangle(Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.faces.push_back({first, first + 1, first + 2});
}

inline Vec3f random_point(Random& random) {
  const float x = random.uniform(), y = random.uniform();
  return {{x, y, random.uniform()}};
}

/// Triangles between random points of a few: no manifold, with repeated and degenerate ones.
inline Mesh soup(uint32_t points, uint32_t faces, uint64_t seed) {
  Random random(seed, 0);
  Mesh mesh;
  for (uint32_t i = 0; i < points; i++) mesh.positions.push_back(random_point(random));
  for (uint32_t i = 0; i < faces; i++) {
    const uint32_t a = random.below(points), b = random.below(points);
    mesh.faces.push_back({a, b, random.below(points)});
  }
  return mesh;
}

/// A unit sphere of latitudes and longitudes as modellers export it: normals, texcoords with a seam and torn poles,
/// colours.
inline Mesh seamed_sphere(uint32_t rings, uint32_t segments) {
  Mesh mesh;
  for (uint32_t i = 0; i <= rings; i++)
    for (uint32_t j = 0; j <= segments; j++) {
      const float v = static_cast<float>(i) / static_cast<float>(rings),
                  u = static_cast<float>(j) / static_cast<float>(segments);
      const float ring = j == segments ? 0 : u;  // the seam's two sides coincide exactly
      const float r = i == 0 || i == rings ? 0 : std::sin(3.14159265f * v);
      const Vec3f p{{r * std::cos(6.2831853f * ring), std::cos(3.14159265f * v), r * std::sin(6.2831853f * ring)}};
      mesh.positions.push_back(p);
      mesh.normals.push_back(normalized(p));
      mesh.texcoords[0].push_back({{u, v}});
      mesh.colors.push_back({{u, v, 1 - u, 1}});
    }
  for (uint32_t i = 0; i < rings; i++)
    for (uint32_t j = 0; j < segments; j++) {
      const uint32_t a = i * (segments + 1) + j, b = a + segments + 1;
      if (i > 0) mesh.faces.push_back({a, a + 1, b});
      if (i + 1 < rings) mesh.faces.push_back({a + 1, b + 1, b});
    }
  return mesh;
}

/// A closed torus with a vertex for each face and corner, flat shaded: every edge is torn.
inline Mesh faceted_torus(int along, int round) {
  const Mesh smooth = knot(along, round);
  Mesh mesh;
  for (const Face& f : smooth.faces) {
    add_triangle(mesh, smooth.positions[f[0]], smooth.positions[f[1]], smooth.positions[f[2]]);
    const Vec3f n = normalized(
        cross(smooth.positions[f[1]] - smooth.positions[f[0]], smooth.positions[f[2]] - smooth.positions[f[0]]));
    mesh.normals.insert(mesh.normals.end(), 3, n);
  }
  return mesh;
}

/// A flat square of cells with a border and a hole.
inline Mesh sheet(uint32_t cells) {
  Mesh mesh;
  for (uint32_t i = 0; i <= cells; i++)
    for (uint32_t j = 0; j <= cells; j++) mesh.positions.push_back({{static_cast<float>(i), 0, static_cast<float>(j)}});
  for (uint32_t i = 0; i < cells; i++)
    for (uint32_t j = 0; j < cells; j++) {
      if (i > cells / 3 && i < cells / 2 && j > cells / 3 && j < cells / 2) continue;
      const uint32_t a = i * (cells + 1) + j, b = a + cells + 1;
      mesh.faces.push_back({a, a + 1, b});
      mesh.faces.push_back({a + 1, b + 1, b});
    }
  return mesh;
}

/// `blades` half planes that meet in one edge, cut into `steps`.
inline Mesh book(uint32_t blades, uint32_t steps) {
  Mesh mesh;
  for (uint32_t s = 0; s <= steps; s++) {
    const float z = static_cast<float>(s);
    mesh.positions.push_back({{0, 0, z}});
    for (uint32_t b = 0; b < blades; b++) {
      const float angle = 6.2831853f * static_cast<float>(b) / static_cast<float>(blades);
      mesh.positions.push_back({{std::cos(angle), std::sin(angle), z}});
    }
  }
  for (uint32_t s = 0; s < steps; s++)
    for (uint32_t b = 0; b < blades; b++) {
      const uint32_t spine = s * (blades + 1), outer = spine + 1 + b;
      mesh.faces.push_back({spine, outer, spine + blades + 1});
      mesh.faces.push_back({outer, outer + blades + 1, spine + blades + 1});
    }
  return mesh;
}

/// A cone of so many faces: one vertex has them all.
inline Mesh umbrella(uint32_t faces) {
  Mesh mesh;
  mesh.positions.push_back({{0, 1, 0}});
  for (uint32_t i = 0; i < faces; i++) {
    const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(faces);
    mesh.positions.push_back({{std::cos(angle), 0, std::sin(angle)}});
    mesh.faces.push_back({0, 1 + (i + 1) % faces, 1 + i});
  }
  return mesh;
}

inline Mesh tetrahedron(const Vec3f& at, float size) {
  Mesh mesh;
  for (const Vec3f& p : {Vec3f{{0, 0, 0}}, Vec3f{{1, 0, 0}}, Vec3f{{0, 1, 0}}, Vec3f{{0, 0, 1}}})
    mesh.positions.push_back(at + p * size);
  mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

inline void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const Face& f : more.faces) mesh.faces.push_back({first + f[0], first + f[1], first + f[2]});
}

inline Mesh scattered(uint32_t pieces, uint64_t seed) {
  Random random(seed, 1);
  Mesh mesh;
  for (uint32_t i = 0; i < pieces; i++) {
    const Vec3f at = random_point(random) * 10.0f;
    if (i % 2)
      append(mesh, tetrahedron(at, 0.1f * random.uniform()));
    else
      add_triangle(mesh, at, at + random_point(random) * 0.1f, at + random_point(random) * 0.1f);
  }
  return mesh;
}

inline Mesh scaled(Mesh mesh, float factor, const Vec3f& shift) {
  for (Vec3f& p : mesh.positions) p = p * factor + shift;
  return mesh;
}

/// Meshes that a simplifier or a coder may stumble over, by name.
inline std::vector<std::pair<std::string, Mesh>> nasty_meshes() {
  std::vector<std::pair<std::string, Mesh>> all;
  const auto add = [&](std::string name, Mesh mesh) { all.emplace_back(std::move(name), std::move(mesh)); };
  add("nothing", {});
  Mesh unused;
  unused.positions = {{{0, 0, 0}}, {{1, 0, 0}}};
  add("vertices without faces", unused);
  Mesh triangle;
  add_triangle(triangle, {{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}});
  add("one triangle", triangle);
  Mesh pair = triangle;
  pair.faces.push_back({0, 2, 1});
  add("a triangle and its back", pair);
  Mesh repeated = triangle;
  repeated.faces.insert(repeated.faces.end(), {{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {2, 1, 0}});
  add("a triangle five times", repeated);
  Mesh degenerate = triangle;
  degenerate.faces = {{0, 0, 0}, {0, 1, 1}, {0, 1, 0}};
  add("degenerate faces only", degenerate);
  add("a tetrahedron", tetrahedron({}, 1));
  Mesh bow_tie = tetrahedron({}, 1);
  append(bow_tie, tetrahedron({}, -1));
  add("two tetrahedra at one point", bow_tie);
  add("a point", scaled(knot(8, 5), 0, {{1, 2, 3}}));
  Mesh line = sheet(6);
  for (Vec3f& p : line.positions) p[2] = 0;
  add("a line", line);
  add("a sheet with a hole", sheet(24));
  add("a book of three blades", book(3, 40));
  add("a book of seven blades", book(7, 12));
  add("an umbrella of 1000 faces", umbrella(1000));
  Mesh crowded = umbrella(1000);  // the speck beside its tip loses its faces first, and has no other near place to go
  append(crowded, scaled(triangle, 1e-3f, {{0, 1, 0}}));
  add("an umbrella and a speck at its tip", crowded);
  add("a sphere with seams", seamed_sphere(24, 32));
  add("a faceted knot", faceted_torus(60, 9));
  add("a thousand pieces", scattered(1000, 1));
  add("huge", scaled(knot(40, 9), 1e36f, {}));
  add("tiny", scaled(knot(40, 9), 1e-20f, {}));
  add("far away", scaled(knot(40, 9), 1, {{1e6f, 0, 0}}));
  for (uint64_t seed = 0; seed < 24; seed++) {
    Random random(seed, 2);
    const uint32_t points = 3 + random.below(60);
    add("soup " + std::to_string(seed), soup(points, 1 + random.below(6 * points), seed));
  }
  add("a large soup", soup(2000, 5000, 99));
  add("a dense soup", soup(80, 6000, 98));
  return all;
}

}  // namespace lightwell
