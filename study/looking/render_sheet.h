// Contact sheet of `vis2hap render --sheet`: measured and generated signals, one row for each fabric.
#pragma once

#include "rendering/composition/render_fabrics.h"
#include "study/looking/contact_sheet.h"

namespace study::looking {

/// Contact sheet of the fabrics, samples, model and quality of the request. Missing signals leave empty cells. Throws badInput
/// if no fabric has a photograph or a measured signal.
ContactSheet contactSheetOf(const rendering::fabrics::Dataset& dataset, const rendering::RenderRequest& request,
                            const std::function<void(int, int, const std::string&)>& progress = {});

/// Writes the sheet as PNG.
void writeContactSheet(const std::filesystem::path& png, const ContactSheet& sheet);

}  // namespace study::looking
