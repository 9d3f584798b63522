#pragma once
#include <memory>

#include "reference/clouds/cloud_lighting.h"
#include "reference/sky/sky_tables.h"

namespace bruma::reference {

/// The light of sun and sky on clouds, seen from an altitude: the sun dimmed and reddened by the air above each point
/// (by the sun's elevation at the camera), the sky as it looks from there, or from the ground where `sky` has a model
/// for comparison. Keeps the tables.
CloudLight light_of_sky(std::shared_ptr<const AtmosphereTables> tables, const scene::Sun& sun, double altitude_m,
                        const scene::Sky& sky = {});

}  // namespace bruma::reference
