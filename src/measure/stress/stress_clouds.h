#pragma once
#include "measure/stress/stress_rig.h"

/// Private to the stress suite of clouds.
namespace bruma::measure {

/// Pictures of random parameters one after the other, each with the history of the one before.
void stress_cloud_history(StressRig& rig, int frames);

}  // namespace bruma::measure
