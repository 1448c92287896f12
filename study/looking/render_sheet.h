// `render --sheet`: what a data set shows of its fabrics and what the generators make of them, on one sheet.
#pragma once

#include "rendering/composition/render_fabrics.h"
#include "study/looking/contact_sheet.h"

namespace study::looking {

/// Rows for the request's fabrics with its samples, model and quality; what a fabric lacks stays empty.
/// Throws badInput where there is neither a photograph nor a measured signal of any of them.
ContactSheet contactSheetOf(const rendering::fabrics::Dataset& dataset, const rendering::RenderRequest& request,
                            const std::function<void(int, int, const std::string&)>& progress = {});

void writeContactSheet(const std::filesystem::path& png, const ContactSheet& sheet);

}  // namespace study::looking
