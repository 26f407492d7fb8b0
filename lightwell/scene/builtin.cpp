// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/builtin.h"

#include <algorithm>

#include "lightwell/scene/relief_knot.h"
#include "lightwell/scene/scene_builder.h"

namespace lightwell {
namespace {

// The reflectances of the Cornell box.
const Lambertian white{.name = "white", .color = {{0.73f, 0.73f, 0.73f}}};
const Lambertian red{.name = "red", .color = {{0.63f, 0.065f, 0.05f}}};
const Lambertian green{.name = "green", .color = {{0.14f, 0.45f, 0.091f}}};
const Lambertian stone{.name = "stone", .color = {{0.72f, 0.7f, 0.66f}}};
const Lambertian lamp{.name = "lamp", .color = {}, .emission = {{14, 12, 9}}};

/// Adds the parallelogram of these corners to a mesh; its front is where corner, corner + u, corner + v turn
/// counter-clockwise.
void add_quad(Mesh& mesh, const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const Vec3f& p : {corner, corner + u, corner + u + v, corner + v}) mesh.positions.push_back(p);
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
}

Vec3f along_x(float length) { return {{length, 0, 0}}; }
Vec3f along_y(float length) { return {{0, length, 0}}; }
Vec3f along_z(float length) { return {{0, 0, length}}; }

/// The six walls of a box, seen from inside.
struct Walls {
  Mesh floor, ceiling, left, right, back, front;
};

/// The walls of a box without its ceiling.
Walls walls_of(const Box3f& box) {
  const Vec3f size = box.size();
  const Vec3f x = along_x(size[0]), y = along_y(size[1]), z = along_z(size[2]);
  Walls walls;
  add_quad(walls.floor, box.lo, z, x);
  add_quad(walls.left, box.lo, y, z);
  add_quad(walls.right, box.lo + x, z, y);
  add_quad(walls.back, box.lo, x, y);
  add_quad(walls.front, box.lo + z, y, x);
  return walls;
}

/// A ceiling at the top of `box` with a rectangular hole in it, and the lamp that fills the hole. The four trapezia of
/// the ceiling share the corners of the hole, so that no gap is left.
struct LampCeiling {
  Mesh ceiling, lamp;

  LampCeiling(const Box3f& box, const Box3f& hole) {
    const float height = box.hi[1];
    for (const Box3f* b : {&box, &hole}) {
      for (const Vec3f& p : {Vec3f{{b->lo[0], height, b->lo[2]}}, Vec3f{{b->hi[0], height, b->lo[2]}},
                             Vec3f{{b->hi[0], height, b->hi[2]}}, Vec3f{{b->lo[0], height, b->hi[2]}}})
        ceiling.positions.push_back(p);
    }
    for (uint32_t i = 0; i < 4; i++) {
      const uint32_t next = (i + 1) % 4;
      ceiling.faces.push_back({i, next, 4 + next});
      ceiling.faces.push_back({i, 4 + next, 4 + i});
    }
    lamp.positions.assign(ceiling.positions.begin() + 4, ceiling.positions.end());
    lamp.faces = {{0, 1, 2}, {0, 2, 3}};
  }
};

Mesh moved(Mesh mesh, float scale, const Vec3f& by) {
  for (Vec3f& p : mesh.positions) p = p * scale + by;
  return mesh;
}

/// The modified Cornell room of Figure 1 of S08 (Pacanowski et al., Efficient Streaming of 3D Scenes with Complex
/// Geometry and Complex Lighting, Web3D 2008): 4 m wide and high and 5 m deep, with a red and a green wall, a lamp in
/// the ceiling and one object of 2 * along * around triangles.
Document cornell_room(uint32_t along, uint32_t around, uint64_t seed) {
  const Box3f room{{{-2, 0, -2.5f}}, {{2, 4, 2.5f}}};
  const Walls walls = walls_of(room);
  const LampCeiling top(room, {{{-0.6f, 4, -1.2f}}, {{0.6f, 4, 0}}});
  const Mesh knot = moved(relief_knot(along, around, seed), 0.8f, {{0, 1.45f, -0.6f}});

  SceneBuilder scene;
  const int white_paint = scene.material(white);
  scene.object("floor", {{walls.floor, white_paint}});
  scene.object("ceiling", {{top.ceiling, white_paint}});
  scene.object("back wall", {{walls.back, white_paint}});
  scene.object("front wall", {{walls.front, white_paint}});
  scene.object("left wall", {{walls.left, scene.material(red)}});
  scene.object("right wall", {{walls.right, scene.material(green)}});
  scene.object("lamp", {{top.lamp, scene.material(lamp)}});
  scene.object("knot", {{knot, scene.material(stone)}});
  scene.camera("camera", {{0, 1.9, 2.4}}, {{0, 1.85, -2.5}}, 1.15, 800, 800);
  return scene.release();
}

Document box(uint64_t seed) { return cornell_room(2620, 210, seed); }
Document box_small(uint64_t seed) { return cornell_room(345, 29, seed); }

constexpr float room_side = 4, room_height = 2.8f, wall_thickness = 0.2f;
constexpr float door_width = 1, door_height = 2.1f;

/// The wall between the rooms, with a doorway through it. It stands from x = 0 to x = wall_thickness.
Mesh wall_with_door() {
  const float beside = (room_side - door_width) / 2;  // of wall, on either side of the door
  const Vec3f thickness = along_x(wall_thickness), up = along_y(room_height);
  Mesh wall;
  for (const float z : {0.0f, beside + door_width}) {
    add_quad(wall, along_z(z), along_z(beside), up);
    add_quad(wall, along_z(z) + thickness, up, along_z(beside));
  }
  const Vec3f lintel = along_z(beside) + along_y(door_height);
  add_quad(wall, lintel, along_z(door_width), along_y(room_height - door_height));
  add_quad(wall, lintel + thickness, along_y(room_height - door_height), along_z(door_width));
  add_quad(wall, lintel, thickness, along_z(door_width));
  add_quad(wall, along_z(beside), thickness, along_y(door_height));
  add_quad(wall, along_z(beside + door_width), along_y(door_height), thickness);
  return wall;
}

/// Two closed rooms with a door between them; the lamp is in the first, the camera in the second.
Document two_rooms(uint64_t seed) {
  const float second = wall_thickness;
  const Box3f lit{{{-room_side, 0, 0}}, {{0, room_height, room_side}}};
  const Box3f dark{{{second, 0, 0}}, {{second + room_side, room_height, room_side}}};
  const Walls lit_walls = walls_of(lit), dark_walls = walls_of(dark);
  const LampCeiling top(lit, {{{-2.5f, room_height, 1.5f}}, {{-1.5f, room_height, 2.5f}}});
  Mesh floor = lit_walls.floor, ceiling = top.ceiling;
  add_quad(floor, {{0, 0, (room_side - door_width) / 2}}, along_z(door_width), along_x(second));
  add_quad(floor, along_x(second), along_z(room_side), along_x(room_side));
  add_quad(ceiling, along_x(second) + along_y(room_height), along_x(room_side), along_z(room_side));
  const Mesh knot = moved(relief_knot(345, 29, seed), 0.55f, {{second + 1.9f, 0.95f, 2.2f}});

  SceneBuilder scene;
  const int white_paint = scene.material(white);
  const int warm = scene.material({.name = "warm", .color = {{0.7f, 0.55f, 0.4f}}});
  const int cool = scene.material({.name = "cool", .color = {{0.5f, 0.6f, 0.7f}}});
  scene.object("floor", {{floor, scene.material({.name = "wood", .color = {{0.5f, 0.4f, 0.3f}}})}});
  scene.object("ceiling", {{ceiling, white_paint}});
  scene.object("first room", {{lit_walls.left, warm}, {lit_walls.back, warm}, {lit_walls.front, warm}});
  scene.object("second room", {{dark_walls.right, cool}, {dark_walls.back, cool}, {dark_walls.front, cool}});
  scene.object("wall with door", {{wall_with_door(), white_paint}});
  scene.object("lamp", {{top.lamp, scene.material({.name = "lamp", .color = {}, .emission = {{30, 27, 22}}})}});
  scene.object("knot", {{knot, scene.material(stone)}});
  scene.camera("camera", {{3.9, 1.6, 3.7}}, {{0.6, 1.1, 1.5}}, 1.1, 800, 600);
  return scene.release();
}

/// A closed box whose walls all reflect one half and emit radiance 1: everywhere inside, from every direction, the
/// radiance is 1 / (1 - 1/2) = 2.
Document furnace(uint64_t) {
  const Box3f room{{{0, 0, 0}}, {{3, 2, 2.5f}}};
  Walls walls = walls_of(room);
  add_quad(walls.ceiling, {{0, 2, 0}}, along_x(3), along_z(2.5f));
  SceneBuilder scene;
  const int glowing = scene.material({.name = "glowing", .color = Vec3f::filled(0.5f), .emission = Vec3f::filled(1)});
  scene.object("walls", {{walls.floor, glowing},
                         {walls.ceiling, glowing},
                         {walls.left, glowing},
                         {walls.right, glowing},
                         {walls.back, glowing},
                         {walls.front, glowing}});
  scene.camera("camera", {{0.4, 1, 2.2}}, {{2, 0.9, 0.5}}, 1, 640, 480);
  return scene.release();
}

}  // namespace

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> scenes = {
      {"box", "a Cornell room with a finely carved knot", box},
      {"box-small", "the same room, the knot less finely carved", box_small},
      {"two-rooms", "a lit and a dark room with a door between", two_rooms},
      {"furnace", "a closed box whose walls all glow: every radiance is 2", furnace},
  };
  return scenes;
}

const BuiltinScene* find_builtin_scene(std::string_view name) {
  const auto& scenes = builtin_scenes();
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const BuiltinScene& s) { return s.name == name; });
  return found == scenes.end() ? nullptr : &*found;
}

}  // namespace lightwell
