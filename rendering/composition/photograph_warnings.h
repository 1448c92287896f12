// Warnings on photographs that the generators cannot use as they are.
#pragma once

#include <string>
#include <vector>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

/// One line for each photograph that differs from all training photographs; one more where the weights do not state theirs.
std::vector<std::string> unfamiliarPhotographs(const RenderedFabrics& rendering);

/// One line for each photograph of which only the middle was used.
std::vector<std::string> cutPhotographs(const RenderedFabrics& rendering);

}  // namespace rendering
