// Report of a rendering: render.json, and lines for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

/// Text of render.json: ranges and their fabrics, samples, computed signals, extension, lost variance, milliseconds.
std::string renderJson(const fabrics::Dataset& dataset, const RenderRequest& request, const RenderedFabrics& rendering);

/// The settings that a quality stands for, and the table that it was chosen from: what they cost there and what they gave up.
nlohmann::ordered_json settingsOf(models::Quality quality);

/// One line for each fabric on the conversion of its sources to maps.
std::vector<std::string> describeMaps(const RenderedFabrics& rendering);

/// One line for each fabric whose photograph varies in colour, because shape from shading assumes that only slopes change
/// its brightness.
std::vector<std::string> shadingWarnings(const RenderedFabrics& rendering);

}  // namespace rendering
