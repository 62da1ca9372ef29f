// Objects that several kinds of scenes use: aircraft, vehicles, trees, buildings.
// Frame: each object stands on z = 0 around the origin. Aircraft and vehicles point toward +x. Buildings have their
// length along x. Units: metres.
// `sides`: number of sides of round parts.
#pragma once

#include "worldgen/scene/scene_builder.hpp"

namespace yars::worldgen {

void draw_fighter(MeshBuilder& mesh, int sides);
void draw_transport(MeshBuilder& mesh, int sides);  // transport aircraft
void draw_truck(MeshBuilder& mesh, const SurfaceKind& body);
void draw_tanker(MeshBuilder& mesh, int sides);  // road tanker
void draw_car(MeshBuilder& mesh, const SurfaceKind& body);
void draw_conifer(MeshBuilder& mesh, double height_m, int sides);
void draw_leafy_tree(MeshBuilder& mesh, double height_m, int sides);
// House with pitched roof and chimney. A dormer and a garage are each added at random.
void draw_house(MeshBuilder& mesh, random::CounterRng& rng);
// Block of flats with rows of windows, a parapet, and the upper ends of the stairwells on the roof.
void draw_block(MeshBuilder& mesh, random::CounterRng& rng);
// High-rise building on a wider base. It narrows in steps toward the top and has machinery and a mast on the roof.
void draw_tower(MeshBuilder& mesh, random::CounterRng& rng);

}  // namespace yars::worldgen
