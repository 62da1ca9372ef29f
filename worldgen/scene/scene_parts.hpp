// Things that stand about in more than one kind of scene. Each stands on z = 0 around the origin, its front along +x.
#pragma once

#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

void draw_fighter(MeshBuilder& sketch, int sides);
void draw_transport(MeshBuilder& sketch, int sides);
void draw_truck(MeshBuilder& sketch, const SurfaceKind& body);
void draw_tanker(MeshBuilder& sketch, int sides);
void draw_car(MeshBuilder& sketch, const SurfaceKind& body);
void draw_conifer(MeshBuilder& sketch, double height_m, int sides);
void draw_leafy_tree(MeshBuilder& sketch, double height_m, int sides);
// A pitched-roof house with chimney, by chance with a porch, dormers, a garage.
void draw_house(MeshBuilder& sketch, Chance& chance);
// Flats: a slab of storeys with window bands, parapet and stair heads.
void draw_block(MeshBuilder& sketch, Chance& chance);
// A tower on a base, stepped back towards its top, with plant on the roof.
void draw_tower(MeshBuilder& sketch, Chance& chance);

}  // namespace yars::worldgen
