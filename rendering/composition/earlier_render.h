// Rendering into a folder that holds images already: what render.json said of them stays, and images that
// the new ranges do not fit are named. Two images of a condition can only be compared where one range
// mapped both.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rendering {

struct JoinedRender {
    std::string json;                   ///< for render.json: the new one and what still holds of the earlier one
    std::vector<std::string> warnings;  ///< a line each: which set, range or mapping changed, which images are left behind
};

/// `json`: of renderJson(). `earlier`: the text of the render.json that lies there; one that cannot be read is
/// replaced, with a warning. `where` names it in the warnings.
JoinedRender joined(const std::string& json, std::string_view earlier, const std::string& where);

}  // namespace rendering
