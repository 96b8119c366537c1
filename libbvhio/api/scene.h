// The handle of scenes.
#pragma once

#include <memory>

#include "api/bvhio.h"
#include "scene/scene.h"

struct BvhioScene {
    bvhio::Scene scene;
};
