// Radar cross sections of ships and of corner reflectors on their axis, by size and frequency.
// Source: docs/spec/physics.md#targets.
#pragma once

#include "lib/radar/modes.hpp"

namespace yars::radar {

// Median cross section [m^2] of a ship at grazing incidence: 52 sqrt(f [MHz]) (D [kt])^1.5.
// `displacement_t`: full load displacement [t]. Source: Skolnik 1974, IEEE Trans. AES-10.
double ship_cross_section_m2(double displacement_t, double frequency_ghz);

// Cross section [m^2] on the axis. Trihedral of right triangles: 4 pi a^4 / (3 lambda^2). Dihedral of two squares:
// 8 pi a^4 / lambda^2. Precondition: is_reflector(echo).
double reflector_cross_section_m2(TargetEcho echo, double edge_m, double frequency_ghz);

// Edge [m] of a dihedral with this cross section on its axis.
double dihedral_edge_m(double cross_section_m2, double frequency_ghz);

}  // namespace yars::radar
