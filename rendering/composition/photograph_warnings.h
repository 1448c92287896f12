// Warnings on photographs that the generators cannot use as they are.
#pragma once

#include <string>
#include <vector>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

/// Throws badInput that names every photograph that is not cloth (cloth_check.h): relief and friction of other things would look
/// like any other result.
void refuseOtherThings(const RenderedFabrics& rendering);

/// One line for each photograph that is unusual for cloth, or not cloth at all.
std::vector<std::string> strangePhotographs(const RenderedFabrics& rendering);

/// One line for each photograph that tells little of its friction: its 90 % interval is nearly that of any cloth.
std::vector<std::string> uncertainFriction(const RenderedFabrics& rendering);

/// One line for each photograph of which only the middle was used.
std::vector<std::string> cutPhotographs(const RenderedFabrics& rendering);

}  // namespace rendering
