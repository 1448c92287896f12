// The sheet of `vis2hap render --sheet`: measured and generated signals of fabrics, one row a fabric.
#pragma once

#include "rendering/composition/render_fabrics.h"
#include "study/looking/contact_sheet.h"

namespace study::looking {

/// The sheet for the fabrics, samples, model and quality of the request. A cell stays empty where the fabric has no signal
/// for it. Throws badInput where no fabric has a photograph or a measured signal.
ContactSheet contactSheetOf(const rendering::fabrics::Dataset& dataset, const rendering::RenderRequest& request,
                            const std::function<void(int, int, const std::string&)>& progress = {});

void writeContactSheet(const std::filesystem::path& png, const ContactSheet& sheet);

}  // namespace study::looking
