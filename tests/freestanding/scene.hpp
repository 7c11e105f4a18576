// A scene with everything that a case can have, and the few functions through which another program works with it.
#pragma once

extern "C" {
bool scene_start();               ///< places the particles and starts; false: a fault
bool scene_run(long long steps);  ///< false: a fault
double scene_kinetic_energy();    ///< J
long long scene_listings();       ///< how often near pairs were listed anew
}
