// Check of a photograph before signals are generated from it: how much of it is used, the scale that is assumed, and whether its
// weave is one that a fabric can have at the given scale. Needs neither the networks nor libtorch.
#pragma once

#include <optional>

#include "rendering/models/generation.h"

namespace rendering::models {

struct ModelCardFields;

struct CheckedPhotograph {
    PhotographFacts facts;          ///< the same as generate() returns
    std::optional<double> weaveMm;  ///< period of the weave at the photograph's scale or the assumed one; nullopt: no clear weave
    double finestWeaveMm = 0;       ///< finestWeaveMm() of photograph_at_pitch.h
    bool isScaleDoubtful() const { return !facts.assumedMmPerPixel && weaveMm && *weaveMm < finestWeaveMm; }
};

/// `photograph`: as generate() takes it. `card`: of the model that will generate. Throws badInput for another type of image.
CheckedPhotograph checkPhotograph(const InputPhotograph& photograph, const ModelCardFields& card);

}  // namespace rendering::models
