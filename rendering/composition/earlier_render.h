// Rendering into a folder that already holds images. The contents of its render.json are kept, and images that do not
// fit the new ranges are named. Two images of a condition can only be compared if one range mapped both.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rendering {

struct JoinedRender {
    std::string json;                   ///< new text of render.json, including valid contents of the earlier one
    std::vector<std::string> warnings;  ///< lines on changed sets, ranges and mappings, and the images that keep old ones
};

/// `json`: text from renderJson(). `earlier`: text of the existing render.json; an unreadable one is replaced, with a warning.
/// `where` names it in the warnings.
JoinedRender joined(const std::string& json, std::string_view earlier, const std::string& where);

}  // namespace rendering
